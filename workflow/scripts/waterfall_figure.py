"""Draw the waterfall of a blade and scene. Inputs: campbell, spectrum. Params: caption. Output: png, pdf."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.style import save
from r37core.figures.waterfall import draw_waterfall


def main(snakemake):
    wanted = snakemake.wildcards
    maps = read_dataset(snakemake.input.spectrum).sel(blade=wanted.blade, scene=wanted.scene)
    campbell = read_dataset(snakemake.input.campbell).sel(blade=wanted.blade)
    save(draw_waterfall(maps, campbell, f"{wanted.blade}, {wanted.scene}"), snakemake.output, snakemake.params.caption)


run(snakemake, main)
