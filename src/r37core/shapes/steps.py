"""Steps of the workflow (docs/architecture.md): shapes that move."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list
from r37core.base.plain import from_plain
from r37core.exchange.fields import worst_instants
from r37core.explorer import write_page
from r37core.fem.material import Material
from r37core.mesh.mesh_files import read_vtu
from r37core.results.interactions import InteractionChoice, find_interactions, titles
from r37core.results.regions import read_judged
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.recovery import stress_operator

from . import PARTS, shapes_contents
from .moving import write_mode_shapes, write_worst_shapes


def modes(input: Any, output: Any, params: Any) -> None:
    """Write modes that move. Inputs: mesh (vtu), model. Params: modes, material. Output: folder."""
    mesh, model, material = read_vtu(input.mesh), read_reduced_model(input.model), from_plain(Material, params.material)
    write_mode_shapes(mesh, model, material, params.modes, Path(output.folder))


def worst(input: Any, output: Any, params: Any) -> None:
    """Write worst instants. Inputs: mesh, model, campbell, response, speeds. Output: folder.

    Params: scene, speeds, interactions, material.
    """
    model, response = read_reduced_model(input.model), read_judged(input.response)
    # the elastic material in params and the yield stress that the response was judged by
    material = replace(from_plain(Material, params.material), yield_stress=float(response["yield_stress"]))
    choice = from_plain(InteractionChoice, params.interactions)
    title_of = titles(find_interactions(response, read_dataset(input.campbell), choice))
    files = {speed: file for speed, file in zip(params.speeds, as_list(input.speeds), strict=True) if speed in title_of}
    instants = worst_instants(files.values(), list(files), stress_operator(model, material), False)
    named = {speed: f"{title_of[speed]}, {params.scene}" for speed in instants}
    write_worst_shapes(read_vtu(input.mesh), model, material, instants, named, Path(output.folder))


def page(input: Any, output: Any, params: Any) -> None:
    """Write the page with a blade's shapes. Inputs: modes and worst, folders of shapes. Output: page (html).

    Params: blade, scenes, address (of a file in the report).
    """
    folders = dict(zip(["", *params.scenes], map(Path, [input.modes, *as_list(input.worst)]), strict=True))
    file = Path(output.page)
    explorer = str(params.address(file.parents[1] / "explorer.html"))
    write_page(shapes_contents(folders, explorer), f"Shapes of {params.blade}", file, PARTS)
