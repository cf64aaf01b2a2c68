"""Join one kind of result. Inputs: response.nc of each run. Params: runs, fidelity. Output: rms.nc, spectrum.nc, ..."""

from job import run

from r37core.results.datasets import write_sweep_dataset


def main(snakemake):
    responses = dict(zip(map(tuple, snakemake.params.runs), snakemake.input, strict=True))
    write_sweep_dataset(snakemake.wildcards.kind, responses, snakemake.output[0], {"fidelity": snakemake.params.fidelity})


run(snakemake, main)
