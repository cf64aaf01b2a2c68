"""Steps of the workflow (docs/architecture.md): figures."""

from inspect import signature
from pathlib import Path
from typing import Any

from r37core.base.dataset_file import read_dataset
from r37core.base.io import as_list, function_named
from r37core.base.plain import from_plain
from r37core.results.operating_range import OperatingRange
from r37core.results.regions import judged
from r37core.results.table_file import read_table

from .blade_shapes import draw_blade_shapes
from .style import mark_operating, picture_figure, save


def draw(input: Any, output: Any, params: Any) -> None:
    """Draw a figure. Inputs: named as its function takes them. Outputs: png, pdf.

    Params: those of `targets.drawing`; draw: the function, `module.function`; of: the wildcards; drawn: blades and scenes
    in it, without all of them; caption; operating.
    """
    arguments = dict(params.items())
    operating, drawn = arguments.pop("operating", None), arguments.pop("drawn", {})
    function, caption, of, *_ = (arguments.pop(name) for name in ("draw", "caption", "of", "step", "code"))
    drawing = function_named(function)
    parameters = signature(drawing).parameters
    for name, file in input.items():
        # a name where the module postpones its annotations
        if parameters[name].annotation in (Path, "Path"):
            arguments[name] = Path(file)
        elif file:
            # a table, or the part of a dataset that is of the figure's blade and scene
            arguments[name] = read_table(file) if file.endswith(".csv") else judged(read_dataset(file, drawn | of))
    names = of | ({"title": ", ".join(of.values())} if of else {})
    figure = drawing(**arguments, **{name: names[name] for name in names.keys() & parameters})
    if operating:
        mark_operating(figure, from_plain(OperatingRange, operating))
    save(figure, [output.png, output.pdf], caption)


def blade_shapes(input: Any, output: Any, params: Any) -> None:
    """Draw the meshes of all blades. Inputs: meshes. Params: blades, caption. Outputs: png, pdf."""
    draw_blade_shapes(dict(zip(params.blades, as_list(input.meshes), strict=True)), output.png)
    save(picture_figure(output.png), output.pdf, params.caption)
