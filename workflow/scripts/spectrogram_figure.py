"""Draw spectrograms. Input: signals.nc of one blade and scene. Params: caption. Output: png, pdf."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.spectrograms import draw_spectrograms
from r37core.figures.style import save


def main(snakemake):
    wanted = snakemake.wildcards
    figure = draw_spectrograms(read_dataset(snakemake.input[0]), f"{wanted.blade}, {wanted.scene}")
    save(figure, snakemake.output, snakemake.params.caption)


run(snakemake, main)
