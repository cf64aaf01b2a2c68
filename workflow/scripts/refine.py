"""Ask for the next speeds. Inputs: campbell, or before, speeds, rom. Params: plan, choice, ... Output: round_*.json."""

import math

from job import run

from r37core.adaptive.criterion import refinement_choice_from
from r37core.adaptive.rounds import first_round, measure, read_round, round_after, write_round
from r37core.dataset_file import read_dataset
from r37core.fem.material import Material
from r37core.io import as_list
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.rom_file import read_reduced_model
from r37core.speeds import speed_plan_from
from r37core.time_integration.speed_file import read_speed


def main(snakemake):
    params, given = snakemake.params, snakemake.input
    plan, choice = speed_plan_from(params.plan), refinement_choice_from(params.choice)
    if snakemake.wildcards.round == "0":
        asked = first_round(plan, read_dataset(given.campbell), choice)
    else:
        before = read_round(given.before)
        recovery = StressRecovery(read_reduced_model(given.rom), Material(**params.material)) if params.stress else None
        yield_stress = params.material.get("yield_stress", math.inf)
        gave = {
            speed: measure(read_speed(file), recovery, params.stress_instants, yield_stress)
            for speed, file in zip(before.new, as_list(given.speeds), strict=True)
        }
        asked = round_after(before, gave, plan, choice)
    write_round(asked, snakemake.output[0])


run(snakemake, main)
