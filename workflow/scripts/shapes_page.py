"""One page with a blade's shapes. Inputs: folders of shapes, modes first. Params: scenes. Output: HTML."""

from pathlib import Path

from job import run

from r37core.explorer import write_page
from r37core.shapes import PARTS, shapes_contents


def main(snakemake):
    folders = dict(zip(["", *snakemake.params.scenes], map(Path, snakemake.input), strict=True))
    title = f"Shapes of {snakemake.wildcards.blade}"
    write_page(shapes_contents(folders), title, snakemake.output[0], PARTS)


run(snakemake, main)
