"""The plan of the time signals: of which blades and scenes, at which speeds, from what."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from r37core.config import si_form
from r37core.plain import to_plain
from r37core.plans import paths
from r37core.plans.structure_plan import Imported
from r37core.plans.sweep_plan import Sweep

from .gauge import Gauge
from .section import SECTION, SignalSection

SIGNALS_OF_RUN = "<results>/{blade}/{scene}/signals.nc"


@dataclass(frozen=True)
class Signals:
    """Plan of the signals that the configuration asks for. Methods with `wildcards` are inputs and parameters of rules."""

    imported: Imported
    sweep: Sweep

    @property
    def _section(self) -> SignalSection:
        return self.sweep.settings.section(SECTION)

    @property
    def runs(self) -> list[tuple[str, str]]:
        """Pairs of blade and scene with signals; none without speeds."""
        if self._section.speeds() is None:
            return []
        pairs = self.sweep.runs_with("signal")
        return [(blade, scene) for blade, scene in pairs if self._section.blades == "all" or blade in self._section.blades]

    def gauges(self, wildcards: Any) -> dict[str, dict[str, Any]]:
        """Gauges of a blade as plain values; a blade given by matrices has none."""
        gauges = self._section.gauges if wildcards.blade in self.imported.meshed_blades else {}
        return {name: to_plain(si_form(Gauge, entry)) for name, entry in gauges.items()}

    def inputs(self, wildcards: Any) -> dict[str, str]:
        """Inputs of signals, with those of gauges and of the speeds of interactions."""
        blade, scene, tip_line = wildcards.blade, wildcards.scene, self.tip_line(wildcards)
        files = {
            "prepared": paths.fill(paths.INTEGRATION_STAMP, blade=blade, scene=scene),
            "model": self.sweep.contact_model(wildcards),
            "rom": paths.fill(paths.REDUCED_MODEL, blade=blade, tip_line=tip_line),
        }
        if self.gauges(wildcards):
            files |= {"mesh": paths.fill(paths.MESH, blade=blade)}
            files |= {"whole": paths.fill(paths.WHOLE_BLADE_MODEL, blade=blade, tip_line=tip_line)}
        if self._section.speeds() == "interactions":
            files |= {"campbell": paths.fill(paths.CAMPBELL, blade=blade)}
            files |= {"response": paths.fill(paths.RESPONSE, blade=blade, scene=scene)}
        return files

    @property
    def speeds(self) -> list[float]:
        """Speeds (rad/s) that are named, ascending; none for those of interactions."""
        speeds = self._section.speeds()
        return speeds if isinstance(speeds, list) else []

    @property
    def probes(self) -> list[float]:
        """Angles of the probes (degrees), ascending."""
        return sorted(map(float, self._section.probes_deg))

    def revolutions(self, wildcards: Any) -> int:
        """Number of revolutions at the end that are kept."""
        return self._section.revolutions or self.sweep.settings.scenes[wildcards.scene].revolutions

    def tip_line(self, wildcards: Any) -> str:
        """The line of the contact nodes of a scene."""
        return self.sweep.settings.scenes[wildcards.scene].tip_line


def simulated(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """Signals of each blade and scene."""
    return {SIGNALS_OF_RUN: paths.run_keys(Signals(Imported(sweep.settings), sweep).runs)}


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """All signals in one file, and the figures."""
    runs = paths.run_keys(Signals(Imported(sweep.settings), sweep).runs)
    return {
        "<results>/signals.nc": runs and [{}],
        **paths.pictures("spectrogram_{blade}__{scene}", runs),
        **paths.pictures("orders_{blade}__{scene}", runs),
    }
