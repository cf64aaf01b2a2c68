"""One reading of one scene. Inputs: model (rom, contact). Params: reading, entry, choice, schemas, ... Output: netCDF."""

from dataclasses import replace
from pathlib import Path

from job import run

from r37core.config import checked_scene
from r37core.dataset_file import write_dataset
from r37core.fem.material import Material
from r37core.march.choice import MarchChoice
from r37core.results.stress import StressRecovery
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.studies.readings import HISTORIES, lined_speeds, rigid_speeds, run_reading
from r37core.studies.stability import changed


def main(snakemake):
    params = snakemake.params
    material = Material(**params.material)
    scene = checked_scene(changed(params.entry, params.reading["changes"]), Path(params.schemas))
    choice = MarchChoice(**params.choice)
    choice = replace(choice, time_step=params.reading["steps"] * choice.time_step)
    lined = snakemake.wildcards.kind == "lined"
    dataset = run_reading(
        read_contact_model(snakemake.input.contact),
        StressRecovery(read_reduced_model(snakemake.input.rom), material),
        scene,
        choice,
        (lined_speeds if lined else rigid_speeds)(params.speed_step),
        HISTORIES[snakemake.wildcards.kind],
        material.yield_stress,
    )
    write_dataset(dataset, snakemake.output[0], {"reading": params.reading["what"]})


run(snakemake, main)
