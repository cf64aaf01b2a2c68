"""How cost grows. Input: tradeoff.nc. Outputs: table, figure."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.growth import draw_growth
from r37core.figures.style import save
from r37core.io import atomic_write
from r37core.studies.growth import growth_table, growths


def main(snakemake):
    found = growths(read_dataset(snakemake.input[0]))
    with atomic_write(snakemake.output.table) as partial:
        partial.write_text(growth_table(found), encoding="utf-8")
    save(draw_growth(found), snakemake.output.figure)


run(snakemake, main)
