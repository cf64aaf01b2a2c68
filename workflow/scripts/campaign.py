"""Run every speed of one blade and scene. Inputs: rom, contact model. Params: speeds, scene, choice, ... Output: dataset."""

import math

from job import run

from r37core.fem.material import Material
from r37core.results.response import write_response
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.studies.campaign import run_one_by_one
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.speed_run import run_speed


def main(snakemake):
    params = snakemake.params
    model, choice = read_contact_model(snakemake.input.model), IntegrationChoice(**params.choice)
    stress = "stress" in params.results
    recovery = StressRecovery(read_reduced_model(snakemake.input.rom), Material(**params.material)) if stress else None
    files = run_one_by_one(
        lambda speed: run_speed(model, speed, params.scene, choice, params.results, **params.kept), params.speeds
    )
    write_response(
        files,
        params.speeds,
        snakemake.output[0],
        recovery,
        stress_history_speeds=(),
        stress_instants=params.stress_instants,
        yield_stress=params.material.get("yield_stress", math.inf),
        provenance=params.provenance,
    )


run(snakemake, main)
