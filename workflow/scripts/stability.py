"""Gather the extremes. Inputs: cases (JSON). Output: table."""

from job import run

from r37core.io import read_json, write_text
from r37core.studies.stability import stability_table


def main(snakemake):
    rows = [read_json(file) for file in snakemake.input]
    write_text(stability_table(rows), snakemake.output[0])


run(snakemake, main)
