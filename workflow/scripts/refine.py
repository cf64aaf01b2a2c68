"""Ask for the next speeds. Inputs: campbell, or before and speeds. Params: plan, choice, yields. Output: round_*.json."""

from job import run

from r37core.adaptive.criterion import RefinementChoice
from r37core.adaptive.rounds import first_round, measure_members, read_round, round_after, write_round
from r37core.dataset_file import read_dataset
from r37core.io import as_list
from r37core.plain import from_plain
from r37core.speeds import SpeedPlan


def main(snakemake):
    params, given = snakemake.params, snakemake.input
    plan, choice = from_plain(SpeedPlan, params.plan), from_plain(RefinementChoice, params.choice)
    if snakemake.wildcards.round == "0":
        asked = first_round(plan, read_dataset(given.campbell), choice)
    else:
        before = read_round(given.before)
        gave = measure_members(params.yields, before.new, as_list(given.speeds))
        asked = round_after(before, gave, plan, choice)
    write_round(asked, snakemake.output[0])


run(snakemake, main)
