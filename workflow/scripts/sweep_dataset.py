"""Join one kind of result. Inputs: responses of all runs, first rounds. Params: runs, fidelity. Output: rms.nc, ..."""

from job import run

from r37core.dataset_file import hash_of_parts
from r37core.io import as_list
from r37core.results.datasets import write_sweep_dataset


def main(snakemake):
    files, params = as_list(snakemake.input.responses), snakemake.params
    made = {"fidelity": params.fidelity, "input_hash": hash_of_parts(files)}
    responses = dict(zip(map(tuple, params.runs), files, strict=True))
    write_sweep_dataset(snakemake.wildcards.kind, responses, snakemake.output[0], made)


run(snakemake, main)
