"""Do one run-up. Inputs: model, and stress and campbell if needed. Params: scene, choice, ... Output: run_up_*.npz."""

from job import run

from r37core.contact.scene import Scene
from r37core.dataset_file import read_dataset
from r37core.plain import from_plain
from r37core.rom.contact_model import read_contact_model
from r37core.run_ups.choice import RunUpChoice
from r37core.run_ups.revolutions import record_run_up
from r37core.stress.operator import read_stress_operator
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.speed_file import write_speed


def main(snakemake):
    given, params = snakemake.input, snakemake.params
    stress = read_stress_operator(given.stress) if hasattr(given, "stress") else None
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
        stress=stress,
        yield_stress=params.yield_stress,
    )
    write_speed(result, snakemake.output[0], params.provenance)


run(snakemake, main)
