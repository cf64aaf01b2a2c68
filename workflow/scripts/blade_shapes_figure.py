"""Draw the meshes of all blades. Inputs: mesh.vtu of each. Params: blades. Output: picture."""

from job import run

from r37core.figures.blade_shapes import draw_blade_shapes


def main(snakemake):
    draw_blade_shapes(dict(zip(snakemake.params.blades, snakemake.input, strict=True)), snakemake.output[0])


run(snakemake, main)
