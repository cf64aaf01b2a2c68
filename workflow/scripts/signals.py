"""Join signals. Inputs: signals.nc of each blade and scene. Params: runs, fidelity. Output: signals.nc."""

from job import run

from r37core.dataset_file import hash_of_parts
from r37core.io import as_list
from r37core.signals.dataset import gather_signals


def main(snakemake):
    files, params = as_list(snakemake.input), snakemake.params
    made = {"fidelity": params.fidelity, "input_hash": hash_of_parts(files)}
    gather_signals(dict(zip(map(tuple, params.runs), files, strict=True)), snakemake.output[0], made)


run(snakemake, main)
