"""List run-ups and the rates they need. Input: run_ups.nc. Outputs: runs (run_ups.csv), rates (run_up_rates.csv)."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.results.table_file import write_table
from r37core.run_ups.tables import rate_table, run_up_table


def main(snakemake):
    runs = run_up_table(read_dataset(snakemake.input[0]))
    for table, file in ((runs, snakemake.output.runs), (rate_table(runs), snakemake.output.rates)):
        write_table(table, file, digits=9)


run(snakemake, main)
