"""Draw a map over speed. Inputs: campbell, maps (spectrum.nc or wear.nc). Params: caption. Output: png, pdf."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.maps import draw_spectral_map, draw_wear_map
from r37core.figures.style import save


def main(snakemake):
    wanted = snakemake.wildcards
    draw = {"spectrum": draw_spectral_map, "wear": draw_wear_map}[wanted.kind]
    maps = read_dataset(snakemake.input.maps).sel(blade=wanted.blade, scene=wanted.scene)
    campbell = read_dataset(snakemake.input.campbell).sel(blade=wanted.blade)
    save(draw(maps, campbell, f"{wanted.blade}, {wanted.scene}"), snakemake.output, snakemake.params.caption)


run(snakemake, main)
