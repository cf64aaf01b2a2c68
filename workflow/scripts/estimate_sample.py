"""Time a sample of the runs of one blade and scene. Inputs: rom, contact model. Params: choices by speed, ... Output: JSON."""

from job import run

from r37core.fem.material import Material
from r37core.io import write_json
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.studies.estimate import time_runs
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.speed_run import run_speed


def main(snakemake):
    params = snakemake.params

    def simulate(speed):
        choice = IntegrationChoice(**params.choices[speed])
        model = read_contact_model(snakemake.input.model)
        return run_speed(model, speed, params.scene, choice, params.results, **params.kept)

    times = time_runs(
        simulate,
        list(params.choices),
        params.number,
        read_reduced_model(snakemake.input.rom) if "stress" in params.results else None,
        Material(**params.material) if params.material else None,
        params.stress_instants,
    )
    write_json(times, snakemake.output[0])


run(snakemake, main)
