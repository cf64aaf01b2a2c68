"""Join signals. Inputs: signals.nc of each blade and scene. Params: runs, fidelity. Output: signals.nc."""

from job import run

from r37core.io import as_list
from r37core.signals.dataset import gather_signals


def main(snakemake):
    files = dict(zip(map(tuple, snakemake.params.runs), as_list(snakemake.input), strict=True))
    gather_signals(files, snakemake.output[0], {"fidelity": snakemake.params.fidelity})


run(snakemake, main)
