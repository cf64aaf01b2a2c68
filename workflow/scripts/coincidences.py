"""Where modes of blades meet waves of a casing. Input: campbell. Params: casings. Output: coincidences.csv."""

from job import run

from r37core.contact.elastic_casing import ElasticCasing
from r37core.dataset_file import read_dataset
from r37core.plain import from_plain
from r37core.results.casing_coincidence import coincidence_table
from r37core.results.table_file import write_table


def main(snakemake):
    casings = from_plain(dict[str, ElasticCasing], snakemake.params.casings)
    table = coincidence_table(read_dataset(snakemake.input.campbell), casings)
    write_table(table, snakemake.output[0], digits=8)


run(snakemake, main)
