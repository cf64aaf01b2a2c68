"""Gather the extremes. Inputs: cases (JSON). Output: table."""

import json

from job import run

from r37core.io import atomic_write
from r37core.studies.stability import stability_table


def main(snakemake):
    rows = []
    for file in snakemake.input:
        with open(file, encoding="utf-8") as stream:
            rows.append(json.load(stream))
    with atomic_write(snakemake.output[0]) as partial:
        partial.write_text(stability_table(rows), encoding="utf-8")


run(snakemake, main)
