"""Draw one blade's Campbell diagram. Input: campbell.nc of the blade. Params: caption. Output: png, pdf."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.campbell_diagram import draw_campbell
from r37core.figures.style import save


def main(snakemake):
    save(
        draw_campbell(read_dataset(snakemake.input[0]), snakemake.wildcards.blade),
        snakemake.output,
        snakemake.params.caption,
    )


run(snakemake, main)
