"""How cost grows. Input: tradeoff.nc. Outputs: table, figure."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.style import save
from r37core.io import write_text
from r37core.studies.growth import growth_table, growths
from r37core.studies.growth_figure import draw_growth


def main(snakemake):
    found = growths(read_dataset(snakemake.input[0]))
    write_text(growth_table(found), snakemake.output.table)
    save(draw_growth(found), snakemake.output.figure)


run(snakemake, main)
