"""One reading at one place. Inputs: model (rom, contact). Params: reading, place, scene, choice, ... Output: netCDF."""

from dataclasses import replace

from job import run

from r37core.dataset_file import write_dataset
from r37core.fem.material import Material
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.studies.reading_places import Place
from r37core.studies.readings import Bench, run_place
from r37core.time_integration.integration_choice import IntegrationChoice


def main(snakemake):
    params, given = snakemake.params, snakemake.input
    material = Material(**params.material)
    choice = IntegrationChoice(**params.choice)
    bench = Bench(
        read_contact_model(given.contact),
        StressRecovery(read_reduced_model(given.rom), material),
        params.scene,
        replace(choice, time_step=params.reading["steps"] * choice.time_step),
        material.yield_stress,
    )
    write_dataset(run_place(bench, Place(**params.place)), snakemake.output[0], {"reading": params.reading["what"]})


run(snakemake, main)
