"""Write worst instants. Inputs: mesh, model, campbell, response, speeds. Params: speeds, material, ... Output: folder."""

from dataclasses import replace
from pathlib import Path

from job import run

from r37core.dataset_file import read_dataset
from r37core.exchange.fields import worst_instants
from r37core.fem.material import Material
from r37core.io import as_list
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain
from r37core.results.interactions import InteractionChoice, find_interactions, titles
from r37core.rom.rom_file import read_reduced_model
from r37core.shapes.moving import write_worst_shapes
from r37core.stress.recovery import stress_operator


def main(snakemake):
    given, params = snakemake.input, snakemake.params
    model, response = read_reduced_model(given.model), read_dataset(given.response)
    # the elastic material in params and the yield stress that the response was judged by
    material = replace(from_plain(Material, params.material), yield_stress=float(response["yield_stress"]))
    choice = from_plain(InteractionChoice, params.interactions)
    found = titles(find_interactions(response, read_dataset(given.campbell), choice))
    files = {speed: file for speed, file in zip(params.speeds, as_list(given.speeds), strict=True) if speed in found}
    instants = worst_instants(files.values(), list(files), stress_operator(model, material), False)
    named = {speed: f"{found[speed]}, {snakemake.wildcards.scene}" for speed in instants}
    write_worst_shapes(read_vtu(given.mesh), model, material, instants, named, Path(snakemake.output[0]))


run(snakemake, main)
