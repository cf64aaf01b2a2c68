"""Rank the blades. Inputs: datasets and, if there, tolerances. Param: runs. Output: ranking.csv."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.results.datasets import response_of
from r37core.results.ranking import ranking_table, robustness
from r37core.results.table_file import write_table
from r37core.tolerances.dataset import measures_of_members


def main(snakemake):
    datasets = {kind: read_dataset(file) for kind, file in snakemake.input.items()}
    members = measures_of_members(datasets.pop("tolerances")) if "tolerances" in datasets else None
    found = {(blade, scene): robustness(response_of(datasets, blade, scene)) for blade, scene in snakemake.params.runs}
    write_table(ranking_table(found, members), snakemake.output[0], digits=6)


run(snakemake, main)
