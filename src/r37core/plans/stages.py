"""Stages that rules and single calls from Python share: what does each, and with which parameters."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from r37core.base.io import function_named
from r37core.base.packages import registered
from r37core.base.plain import to_plain
from r37core.blade.definition import shape_modules
from r37core.config import plain, si_fields

from .structure_plan import Structure


@dataclass(frozen=True)
class Stage:
    """A step, as `r37core.fem.steps.mesh`, with its parameters: plain values, and functions of wildcards as rules have them.

    `title`: what the stage is called while it works. `reads`: name of an input -> stage of the same blade that makes it.
    `modules`: those that the step imports by name.
    """

    step: str
    params: Mapping[str, Any]
    title: str = ""
    reads: Mapping[str, str] = field(default_factory=dict)
    modules: Sequence[str] = ()

    def values(self, wildcards: Any) -> dict[str, Any]:
        """The parameters of one job."""
        return {name: param(wildcards) if callable(param) else param for name, param in self.params.items()}


def structure_stages(structure: Structure) -> dict[str, Stage]:
    """Stages from blade shape to Campbell diagram, by the names of their rules."""
    settings = structure.settings
    reduction = reduction_parameters(structure)
    shape = {"definition": structure.definition, "edges": settings.structure.edges, "provenance": structure.shape_provenance}
    regions = {"stress_regions": lambda wildcards: to_plain(settings.stress_regions(wildcards.blade))}
    own = {"material": structure.elastic, **regions, "kept": True}
    diagram = {
        "campbell": si_fields(settings.config.campbell),
        "maximum_speed": settings.structure.maximum_speed_rad_s,
        "tip_line": settings.structure.boundary.tip_line,
        "provenance": structure.structure_provenance,
    }
    reduced = {"rom": "reduced_model"}
    shapes = shape_modules()
    stages = {
        "geometry": Stage("r37core.blade.steps.geometry", shape, "shape", modules=shapes),
        "mesh": Stage(
            "r37core.fem.steps.mesh",
            {"mesh": plain(settings.fidelity.mesh), "disc": structure.disc, "locations": structure.locations},
            "mesh",
            {"geometry": "geometry"},
            shapes,
        ),
        "reduced_model": Stage(
            "r37core.rom.steps.reduced_model",
            {**own, **reduction},
            "matrices and reduced model, the longest stage",
            {"mesh": "mesh"},
        ),
        "contact_model": Stage(
            "r37core.rom.steps.contact_model", {"tip_line": lambda wildcards: wildcards.tip_line}, "contact model", reduced
        ),
        "stress_operator": Stage(
            "r37core.stress.steps.stress_operator", {"material": structure.elastic}, "stress operator", reduced
        ),
        "campbell_of_blade": Stage("r37core.results.steps.campbell_of_blade", diagram, "Campbell diagram", reduced),
    }
    for more in registered("STAGES").values():
        stages |= function_named(more)(structure)
    return stages


def reduction_parameters(structure: Structure) -> dict[str, Any]:
    """Parameters of a stage that makes a reduced model, whatever from."""
    return {
        "boundary": structure.boundary,
        "reduction": structure.reduction,
        "contact": structure.location_of_contact,
        "provenance": structure.structure_provenance,
    }
