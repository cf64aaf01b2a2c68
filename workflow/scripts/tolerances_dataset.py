"""Join the members' responses. Inputs: responses, first rounds. Params: members, numbers, values. Output: tolerances.nc."""

import math

from job import run

from r37core.dataset_file import hash_of_parts, write_dataset
from r37core.io import as_list
from r37core.tolerances.dataset import MemberRun, tolerances_dataset


def main(snakemake):
    files, params = as_list(snakemake.input.responses), snakemake.params
    runs = (
        MemberRun(**one, values=tuple(math.nan if value is None else value for value in values), file=file)
        for one, values, file in zip(params.members, params.values, files, strict=True)
    )
    made = {"fidelity": params.fidelity, "input_hash": hash_of_parts(files)}
    write_dataset(tolerances_dataset(runs, params.numbers), snakemake.output[0], made)


run(snakemake, main)
