"""One page to look at all results. Inputs: datasets, if there tolerances, summary. Params: title, shapes. Output: HTML."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.explorer import write_page
from r37core.explorer.contents import explorer_contents
from r37core.results.table_file import read_table


def main(snakemake):
    files = dict(snakemake.input.items())
    interactions = read_table(files.pop("summary"))
    datasets = {kind: read_dataset(file) for kind, file in files.items()}
    params = snakemake.params
    write_page(explorer_contents(datasets, interactions, params.shapes), params.title, snakemake.output[0])


run(snakemake, main)
