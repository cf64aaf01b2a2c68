"""The plan of requirements: what is judged, by what, and where it lies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from r37core.base.plain import to_plain
from r37core.config import operating_range
from r37core.plans import paths
from r37core.plans.extension import Extension, Panel
from r37core.plans.sweep_plan import Sweep

from .checks import can_be_judged, remarks
from .section import SECTION

VERDICT = "<results>/verdict.csv"


@dataclass(frozen=True)
class Judged:
    """Plan of what is judged in a run."""

    sweep: Sweep

    @property
    def requirements(self) -> dict[str, Any]:
        """The requirements, as plain values."""
        return to_plain(self.sweep.settings.section(SECTION).requirements())

    @property
    def volumes(self) -> list[str]:
        """Files that say the volume of each blade in `densities`: its geometry, or the mesh of another program."""
        blades = self.sweep.settings.blades
        patterns = {name: paths.GEOMETRY if blades[name].has_profiles else paths.MESH for name in self.densities}
        return [paths.fill(pattern, blade=name) for name, pattern in patterns.items()]

    @property
    def densities(self) -> dict[str, float]:
        """Density (kg/m3) of each blade whose volume is known: of all but those given by matrices."""
        blades = self.sweep.settings.blades.items()
        return {name: blade.material.density for name, blade in blades if blade.material is not None and not blade.is_matrices}

    @property
    def clearance(self) -> dict[str, float]:
        """Clearance (m) of each scene where it is the same at every speed."""
        casings = {name: chosen.scene.casing for name, chosen in self.sweep.settings.scenes.items()}
        return {name: casing.clearance for name, casing in casings.items() if not casing.changes_with_speed}

    @property
    def thickness(self) -> dict[str, float]:
        """Thickness (m) of the lining of each scene that has one."""
        linings = {name: chosen.scene.lining for name, chosen in self.sweep.settings.scenes.items()}
        return {name: lining.thickness for name, lining in linings.items() if lining is not None}


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The list of what lies in the operating range, and the verdict, where there are requirements."""
    once: paths.Wildcards = [{}] if operating_range(sweep.settings) else []
    return {**verdict(sweep), "<results>/operating.csv": once}


def verdict(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The verdict."""
    judged = operating_range(sweep.settings) and sweep.settings.section(SECTION).requirements().any
    return {VERDICT: [{}] if judged else []}


EXTENSION = Extension(
    name="requirements",
    section=SECTION,
    checks=(can_be_judged,),
    targets=targets,
    verdict=verdict,
    remarks=remarks,
    closing="requirements.table.closing",
    panel=Panel(verdict, "requirements.panel.contents", "requirements/panel.js"),
)
