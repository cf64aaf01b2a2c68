"""exports of config.yaml, and their plan: which files, from what, with which numbers."""

from dataclasses import dataclass
from typing import Any, Literal

from r37core.base.plain import to_plain
from r37core.config.section import ExtensionSection, Section, option
from r37core.fem.orientation import OURS
from r37core.plans import paths
from r37core.plans.extension import Extension
from r37core.plans.sweep_plan import Sweep

FORMATS = ("msh", "vtu", "inp")
"""Suffixes of the files of a mesh; .inp is a complete CalculiX or Abaqus deck."""


class ExportSection(Section):
    """Files of `snakemake exports`."""

    modes: int = option("Number of modes, at rest and at structure.maximum_speed_rad_s", 10, ge=1, le=30)
    stress_speeds: Literal["worst", "all"] = option(
        "Speeds whose worst instant is written; worst: that of the largest stress of each blade and scene", "worst"
    )


SECTION = ExtensionSection("exports", ExportSection, ExportSection())


EXPORTED_MESH = "<results>/exports/{blade}/mesh.{format}"
EXPORTED_SURFACE = "<results>/exports/{blade}/surface.step"
EXPORTED_MODES = "<results>/exports/{blade}/modes"
EXPORTED_STRESS = "<results>/exports/{blade}/stress_{scene}"
EXPORTED_MATRICES = "<results>/exports/{blade}/matrices"


@dataclass(frozen=True)
class Exports:
    """Plan of the exports. Methods with `wildcards` are inputs and parameters of rules."""

    sweep: Sweep

    @property
    def choice(self) -> dict[str, Any]:
        """The number of modes, and the speeds (rad/s) of modes and matrices."""
        settings = self.sweep.settings
        highest = settings.structure.maximum_speed_rad_s
        speeds = {"mode_speeds": (0.0, highest), "matrix_speeds": (0.0, 0.5 * highest, highest)}
        return {"modes": settings.section(SECTION).modes, **speeds}

    def orientation(self, wildcards: Any) -> Any:
        """Axes and unit in which results are written: those of an imported mesh, or the blade's own frame."""
        definition = self.sweep.settings.blades[wildcards.blade].definition
        return to_plain(getattr(definition, "orientation", OURS))


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """Files and folders that this run's configuration asks for."""
    meshed = sweep.meshed_blades
    return {
        EXPORTED_MESH: [{"blade": blade, "format": name} for blade in meshed for name in FORMATS],
        EXPORTED_MODES: paths.of("blade", meshed),
        EXPORTED_SURFACE: paths.of("blade", sweep.made_by("geometry")),
        EXPORTED_MATRICES: paths.of("blade", sweep.settings.blades),
        EXPORTED_STRESS: paths.run_keys(sweep.runs_with("stress")),
    }


EXTENSION = Extension(name="exports", section=SECTION, targets=targets, look_at="<results>/exports", made_on_request=True)
