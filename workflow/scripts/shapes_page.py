"""One page with a blade's shapes. Inputs: folders of shapes, modes first. Params: scenes. Output: HTML."""

from pathlib import Path

from job import run

from r37core.explorer import write_page
from r37core.shapes import PARTS, shapes_contents


def main(snakemake):
    folders = dict(zip(["", *snakemake.params.scenes], map(Path, snakemake.input), strict=True))
    title = f"Shapes of {snakemake.wildcards.blade}"
    file = Path(snakemake.output[0])
    explorer = str(snakemake.report_href(file.parents[1] / "explorer.html"))
    write_page(shapes_contents(folders, explorer), title, file, PARTS)


run(snakemake, main)
