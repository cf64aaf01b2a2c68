"""Steps of the workflow (docs/architecture.md): the shape of a blade."""

from typing import Any

from .definition import shape_from_plain
from .geometry_file import write_geometry


def geometry(input: Any, output: Any, params: Any) -> None:
    """Build a blade, or raise BladeShapeError. Params: definition (Shape), edges, provenance. Output: geometry (nc)."""
    definition = shape_from_plain(params.definition)
    write_geometry(definition.build(round_edges=params.edges == "round"), output.geometry, params.provenance)
