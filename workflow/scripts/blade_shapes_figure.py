"""Draw the meshes of all blades. Inputs: mesh.vtu of each. Params: blades, caption. Output: png, pdf."""

from job import run

from r37core.figures.blade_shapes import draw_blade_shapes
from r37core.figures.style import picture_figure, save


def main(snakemake):
    png, pdf = snakemake.output.png, snakemake.output.pdf
    draw_blade_shapes(dict(zip(snakemake.params.blades, snakemake.input, strict=True)), png)
    save(picture_figure(png), pdf, snakemake.params.caption)


run(snakemake, main)
