"""Compare the designs of families. Inputs: campbell, summary, stress, geometry. Params: designs, densities, ... Output: CSV."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.io import as_list
from r37core.results.designs import design_table
from r37core.results.table_file import read_table, write_table


def main(snakemake):
    params, given = snakemake.params, snakemake.input
    stress = read_dataset(given.stress) if given.get("stress") else None
    files = dict(zip(params.designs, as_list(given.geometry), strict=True))
    masses = {blade: params.densities[blade] * float(read_dataset(file)["volume"]) for blade, file in files.items()}
    table = design_table(params.designs, masses, read_dataset(given.campbell), stress, read_table(given.summary), params.scenes)
    write_table(table, snakemake.output[0], digits=6)


run(snakemake, main)
