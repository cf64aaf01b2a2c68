"""Steps of the workflow (docs/architecture.md): figures."""

from collections.abc import Callable
from functools import partial
from inspect import signature
from pathlib import Path
from pkgutil import resolve_name
from typing import Any

from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list
from r37core.base.plain import from_plain
from r37core.results.operating_range import OperatingRange
from r37core.results.table_file import read_table
from r37core.rom.rom_file import read_reduced_model

from .blade_shapes import draw_blade_shapes
from .fatigue_map import draw_fatigue
from .style import mark_operating, picture_figure, save


def draw(input: Any, output: Any, params: Any) -> None:
    """Draw a figure. Inputs: named as its function takes them. Outputs: png, pdf.

    Params: those of `reporting.drawing`; draw: the function, `module.function`; of: the wildcards; drawn: blades and scenes
    in it, without all of them; caption; operating.
    """
    arguments = dict(params.items())
    operating, drawn = arguments.pop("operating", None), arguments.pop("drawn", {})
    function, caption, of, *_ = (arguments.pop(name) for name in ("draw", "caption", "of", "step", "code"))
    # a table, the part of a dataset that is of the figure's blade and scene, or a folder
    readers: dict[str, Callable[[str], Any]] = {".csv": read_table, ".nc": partial(read_dataset, part=drawn | of), "": Path}
    arguments |= {name: readers[Path(file).suffix](file) for name, file in input.items()}
    drawing = resolve_name(function)
    names = of | ({"title": ", ".join(of.values())} if of else {})
    figure = drawing(**arguments, **{name: names[name] for name in names.keys() & signature(drawing).parameters})
    if operating:
        mark_operating(figure, from_plain(OperatingRange, operating))
    save(figure, [output.png, output.pdf], caption)


def fatigue(input: Any, output: Any, params: Any) -> None:
    """Draw where a blade is nearest to the Goodman line. Inputs: mesh (vtu), rom, response. Outputs: png, pdf.

    Params: title, caption.
    """
    nodes, response = read_reduced_model(input.rom).stress_submesh.nodes, read_dataset(input.response)
    figure = draw_fatigue(input.mesh, nodes, response, params.title)
    save(figure, [output.png, output.pdf], params.caption)


def blade_shapes(input: Any, output: Any, params: Any) -> None:
    """Draw the meshes of all blades. Inputs: meshes. Params: blades, caption. Outputs: png, pdf."""
    draw_blade_shapes(dict(zip(params.blades, as_list(input.meshes), strict=True)), output.png)
    save(picture_figure(output.png), output.pdf, params.caption)
