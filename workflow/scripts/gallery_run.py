"""Stress of every revolution at a few speeds. Inputs: rom, model, rms. Params: scene, choice, lined, ... Output: dataset."""

from job import run

from r37core.dataset_file import read_dataset, write_dataset
from r37core.fem.material import Material
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.studies.gallery import histories
from r37core.studies.readings import Bench
from r37core.time_integration.integration_choice import IntegrationChoice


def main(snakemake):
    given, params, blade = snakemake.input, snakemake.params, snakemake.wildcards.blade
    material = Material(**params.material)
    recovery = StressRecovery(read_reduced_model(given.rom), material)
    choice = IntegrationChoice(**params.choice)
    bench = Bench(read_contact_model(given.model), recovery, params.scene, choice, material.yield_stress)
    rms = {"rms": read_dataset(given.rms)}
    write_dataset(histories(bench, rms, blade, snakemake.wildcards.scene, params.lined), snakemake.output[0])


run(snakemake, main)
