"""Draw the responses of all blades. Input: rms.nc. Params: caption. Output: png, pdf."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.response_curves import draw_response_overview
from r37core.figures.style import save


def main(snakemake):
    save(draw_response_overview(read_dataset(snakemake.input[0])), snakemake.output, snakemake.params.caption)


run(snakemake, main)
