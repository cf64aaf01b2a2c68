"""Write docs/gallery.md. Inputs: datasets, meshes, modes, histories, ... Params: scenes, runs, ... Outputs: page, pictures."""

from pathlib import Path

from job import run

from r37core.dataset_file import read_dataset
from r37core.io import write_text
from r37core.published import BLADES
from r37core.studies.gallery import GalleryData
from r37core.studies.gallery_figures import draw_gallery
from r37core.studies.gallery_page import gallery_page
from r37core.studies.gallery_plan import modes_file
from r37core.studies.gallery_shapes import draw_mesh, draw_modes, draw_variants


def main(snakemake):
    given, params = snakemake.input, snakemake.params
    datasets = {kind: read_dataset(given[kind]) for kind in ("campbell", "rms", "spectrum", "stress", "wear")}
    histories = {tuple(key): read_dataset(file) for key, file in zip(params.runs, given.histories, strict=True)}
    data = GalleryData.of(datasets, histories, params.scenes, params.yield_stress)
    folder, meshes = Path(snakemake.output.pictures[0]).parent, dict(zip(BLADES, given.meshes, strict=True))
    reference = meshes.pop("Ref")
    draw_gallery(data, folder)
    draw_modes(modes_file(given.modes), folder / "modes.png")
    nodes = draw_mesh(reference, params.submesh, folder / "mesh.png")
    draw_variants(meshes, reference, folder / "variants.png")
    write_text(gallery_page(data, read_dataset(given.geometry), nodes, params.fidelity), snakemake.output.page)


run(snakemake, main)
