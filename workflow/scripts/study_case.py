"""Run one case of a study. Inputs: contact model, and rom, cost, ... if needed. Param: case. Output: response."""

from job import run

from r37core.plain import from_plain
from r37core.studies.case import Case
from r37core.studies.runner import run_case_of_files


def main(snakemake):
    run_case_of_files(from_plain(Case, snakemake.params.case), dict(snakemake.input.items()), snakemake.output[0])


run(snakemake, main)
