"""Draw the blades of a scene side by side. Inputs: campbell, rms, perhaps stress. Params: caption. Output: png, pdf."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.comparison import draw_comparison
from r37core.figures.style import save


def main(snakemake):
    scene = snakemake.wildcards.scene
    datasets = {kind: read_dataset(file) for kind, file in snakemake.input.items()}
    of_scene = {kind: data if kind == "campbell" else data.sel(scene=scene) for kind, data in datasets.items()}
    figure = draw_comparison(of_scene["campbell"], of_scene["rms"], of_scene.get("stress"), scene)
    save(figure, snakemake.output, snakemake.params.caption)


run(snakemake, main)
