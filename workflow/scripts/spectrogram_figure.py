"""Draw spectrograms. Input: signals.nc of one blade and scene. Output: picture."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.signals import draw_spectrograms
from r37core.figures.style import save


def main(snakemake):
    wanted = snakemake.wildcards
    save(draw_spectrograms(read_dataset(snakemake.input[0]), f"{wanted.blade}, {wanted.scene}"), snakemake.output[0])


run(snakemake, main)
