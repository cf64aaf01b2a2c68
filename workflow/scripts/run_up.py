"""Do one run-up. Inputs: model, and rom and campbell if needed. Params: scene, choice, ... Output: run_up_*.npz."""

import math

from job import run

from r37core.contact.scene import Scene
from r37core.dataset_file import read_dataset
from r37core.fem.material import Material
from r37core.plain import from_plain
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.run_ups.choice import RunUpChoice
from r37core.run_ups.revolutions import record_run_up
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.speed_file import write_speed


def main(snakemake):
    given, params = snakemake.input, snakemake.params
    material = from_plain(Material | None, params.material)
    recovery = StressRecovery(read_reduced_model(given.rom), material) if "stress" in params.results else None
    choice = from_plain(IntegrationChoice, params.choice)
    campbell = read_dataset(given.campbell) if hasattr(given, "campbell") else None
    asked, name = from_plain(RunUpChoice, params.run_up), snakemake.wildcards.run_up
    result = record_run_up(
        read_contact_model(given.model),
        from_plain(Scene, params.scene),
        choice,
        asked.of_blade(choice.samples_per_revolution, campbell, name),
        params.results,
        highest_order=params.highest_order,
        recovery=recovery,
        yield_stress=material.yield_stress if material else math.inf,
    )
    write_speed(result, snakemake.output[0], params.provenance)


run(snakemake, main)
