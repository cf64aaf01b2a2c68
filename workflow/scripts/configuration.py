"""Keep what a run is made with. Params: merged. Output: JSON."""

from job import run

from r37core.io import write_json


def main(snakemake):
    write_json(snakemake.params.merged, snakemake.output[0])


run(snakemake, main)
