"""Steps of the workflow (docs/architecture.md): figures."""

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

    Params: those of `reporting.drawing`; draw: the function, `module.function`; of: the wildcards; caption; operating.
    """
    arguments = dict(params.items())
    operating = arguments.pop("operating", None)
    function, caption, of, *_ = (arguments.pop(name) for name in ("draw", "caption", "of", "step", "code"))
    # a table, or the part of a dataset that is of the figure's blade and scene
    arguments |= {name: read_table(file) if file.endswith(".csv") else read_dataset(file, of) for name, file in input.items()}
    if of:
        arguments["title"] = ", ".join(of.values())
    figure = resolve_name(function)(**arguments)
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
