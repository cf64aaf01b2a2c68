"""Refined speeds against whole grids. Inputs: campbell, campaigns. Params: runs, plans, choice, ... Output: table."""

from job import run

from r37core.adaptive.criterion import refinement_choice_from
from r37core.dataset_file import read_dataset
from r37core.io import write_text
from r37core.results.interactions import InteractionChoice
from r37core.speeds import speed_plan_from
from r37core.studies.refinement import compare, plain_grid, replay
from r37core.studies.refinement_table import refinement_table


def main(snakemake):
    params = snakemake.params
    choice, interactions = refinement_choice_from(params.choice), InteractionChoice(**params.interactions)
    diagrams = read_dataset(snakemake.input.campbell)
    ways = {"refined": {}} | {f"every {step:g} rad/s": {} for step in params.steps}
    every = {}
    for place, plan, file in zip(map(tuple, params.runs), params.plans, snakemake.input.campaigns, strict=True):
        response, campbell, plan = read_dataset(file), diagrams.sel(blade=place[0]), speed_plan_from(plan)
        every[place] = response.sizes["speed"]
        ways["refined"][place] = compare(response, campbell, replay(response, campbell, plan, choice), interactions)
        for step in params.steps:
            ways[f"every {step:g} rad/s"][place] = compare(response, campbell, [plain_grid(plan, step)], interactions)
    write_text(refinement_table(ways, every), snakemake.output[0])


run(snakemake, main)
