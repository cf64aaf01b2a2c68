"""Join run-ups. Inputs: run_up_*.npz of each blade and scene. Params: runs, fidelity. Output: run_ups.nc."""

from job import run

from r37core.io import as_list
from r37core.run_ups.dataset import write_run_ups


def main(snakemake):
    params = snakemake.params
    files = dict(zip(map(tuple, params.runs), as_list(snakemake.input), strict=True))
    write_run_ups(files, snakemake.output[0], {"fidelity": params.fidelity})


run(snakemake, main)
