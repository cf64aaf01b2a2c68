"""Steps of the workflow (docs/architecture.md): files that pictures of shapes are drawn from."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list
from r37core.base.plain import from_plain
from r37core.fem.material import Material
from r37core.mesh.mesh_files import read_vtu
from r37core.results.interactions import InteractionChoice, find_interactions, titles
from r37core.results.regions import read_judged
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.recovery import stress_operator
from r37studies.fields import Target, worst_instants, write_modes

from .worst_shapes import write_worst_shapes


def modes(input: Any, output: Any, params: Any) -> None:
    """Write modes at rest with their stress. Inputs: mesh (vtu), model. Params: modes, material. Output: folder."""
    mesh, model, material = read_vtu(input.mesh), read_reduced_model(input.model), from_plain(Material, params.material)
    write_modes(mesh, model, [0.0], params.modes, Target(Path(output.folder)), material)


def worst(input: Any, output: Any, params: Any) -> None:
    """Write worst instants. Inputs: mesh, model, campbell, response, speeds. Output: folder.

    Params: scene, speeds, interactions, material.
    """
    model, response = read_reduced_model(input.model), read_judged(input.response)
    # the elastic material in params and the yield stress that the response was judged by
    material = replace(from_plain(Material, params.material), yield_stress=float(response["yield_stress"]))
    choice = from_plain(InteractionChoice, params.interactions)
    title_of = titles(find_interactions(response, read_dataset(input.campbell), choice))
    files = {speed: file for speed, file in zip(params.speeds, as_list(input.speeds), strict=True) if speed in title_of}
    instants = worst_instants(files.values(), list(files), stress_operator(model, material), False)
    named = {speed: f"{title_of[speed]}, {params.scene}" for speed in instants}
    write_worst_shapes(read_vtu(input.mesh), model, material, instants, named, Path(output.folder))
