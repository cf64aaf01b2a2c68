"""Ask for the next speeds. Inputs: campbell, or before, speeds, rom. Params: plan, choice, ... Output: round_*.json."""

import math

from job import run

from r37core.adaptive.criterion import RefinementChoice
from r37core.adaptive.rounds import first_round, measure, read_round, round_after, write_round
from r37core.dataset_file import read_dataset
from r37core.fem.material import Material
from r37core.io import as_list
from r37core.plain import from_plain
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.rom_file import read_reduced_model
from r37core.speeds import SpeedPlan
from r37core.time_integration.speed_file import read_speed


def main(snakemake):
    params, given = snakemake.params, snakemake.input
    plan, choice = from_plain(SpeedPlan, params.plan), from_plain(RefinementChoice, params.choice)
    if snakemake.wildcards.round == "0":
        asked = first_round(plan, read_dataset(given.campbell), choice)
    else:
        before = read_round(given.before)
        material = from_plain(Material | None, params.material)
        recovery = StressRecovery(read_reduced_model(given.rom), material) if params.stress else None
        yield_stress = material.yield_stress if material else math.inf
        gave = {
            speed: measure(read_speed(file), recovery, params.stress_instants, yield_stress)
            for speed, file in zip(before.new, as_list(given.speeds), strict=True)
        }
        asked = round_after(before, gave, plan, choice)
    write_round(asked, snakemake.output[0])


run(snakemake, main)
