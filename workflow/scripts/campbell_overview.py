"""Draw the Campbell diagrams of all blades together. Input: campbell.nc of all. Params: caption. Output: png, pdf."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.campbell_diagram import draw_campbell_overview
from r37core.figures.style import save


def main(snakemake):
    save(draw_campbell_overview(read_dataset(snakemake.input[0])), snakemake.output, snakemake.params.caption)


run(snakemake, main)
