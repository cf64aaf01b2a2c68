"""Draw one blade's response. Inputs: campbell, rms and, where computed, stress. Params: caption. Output: png, pdf."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.response_curves import draw_response
from r37core.figures.style import save


def main(snakemake):
    blade = snakemake.wildcards.blade
    datasets = {kind: read_dataset(file).sel(blade=blade) for kind, file in snakemake.input.items()}
    save(
        draw_response(blade, datasets["campbell"], datasets["rms"], datasets.get("stress")),
        snakemake.output,
        snakemake.params.caption,
    )


run(snakemake, main)
