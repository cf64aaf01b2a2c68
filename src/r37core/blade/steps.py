"""Steps of the workflow (docs/architecture.md): the shape of a blade."""

from typing import Any

from r37core.base.plain import from_plain

from .definition import Shape
from .geometry_file import write_geometry


def geometry(input: Any, output: Any, params: Any) -> None:
    """Build a blade, or raise BladeShapeError. Params: definition (profiles or sections), edges, provenance. Output: geometry (nc)."""
    definition = from_plain(Shape, params.definition)
    write_geometry(definition.build(round_edges=params.edges == "round"), output.geometry, params.provenance)
