"""Draw a folder of shapes. Input: folder. Params: caption. Output: png, pdf."""

from pathlib import Path

from job import run

from r37core.figures.style import save
from r37core.shapes.stills import draw_shapes


def main(snakemake):
    save(draw_shapes(Path(snakemake.input[0])), snakemake.output, snakemake.params.caption)


run(snakemake, main)
