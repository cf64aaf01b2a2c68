"""Compare the designs of families. Inputs: datasets, summary, geometry. Params: designs, densities, scenes. Output: CSV."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.designs.table import design_table
from r37core.io import as_list
from r37core.results.table_file import read_table, write_table


def main(snakemake):
    params, given = snakemake.params, dict(snakemake.input.items())
    summary, shapes = read_table(given.pop("summary")), as_list(given.pop("geometry"))
    files = dict(zip(params.designs, shapes, strict=True))
    masses = {blade: params.densities[blade] * float(read_dataset(file)["volume"]) for blade, file in files.items()}
    datasets = {kind: read_dataset(file) for kind, file in given.items()}
    table = design_table(params.designs, masses, datasets, summary, params.scenes)
    write_table(table, snakemake.output[0], digits=6)


run(snakemake, main)
