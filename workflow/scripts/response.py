"""Reduce the speeds of one blade and scene. Inputs: speeds. Params: speeds, yield_stress, ... Output: response.nc."""

from job import run

from r37core.io import as_list
from r37core.results.response import write_response


def main(snakemake):
    params = snakemake.params
    write_response(
        as_list(snakemake.input.speeds),
        params.speeds,
        snakemake.output[0],
        stress_history_speeds=params.stress_history_speeds,
        yield_stress=params.yield_stress,
        provenance=params.provenance,
    )


run(snakemake, main)
