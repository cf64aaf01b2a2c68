"""Draw a folder of shapes. Input: folder. Output: picture."""

from pathlib import Path

from job import run

from r37core.shapes.stills import draw_shapes


def main(snakemake):
    draw_shapes(Path(snakemake.input[0]), snakemake.output[0])


run(snakemake, main)
