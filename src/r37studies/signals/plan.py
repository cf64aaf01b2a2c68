"""The plan of the signals: of which blades and scenes, at which speeds, from what, and which files are made of them."""

from dataclasses import dataclass
from typing import Any

from r37core.base.plain import to_plain
from r37core.config import Settings, si_form
from r37core.config.cross_checks import slow_run_can_be_done
from r37core.config.settings import length_of_run
from r37core.plans import paths
from r37core.plans.extension import Extension
from r37core.plans.sweep_plan import Sweep
from r37core.stress.gauge import Gauge

from .section import SECTION, SignalSection

SIGNALS_OF_RUN = "<results>/{blade}/{scene}/signals.nc"


@dataclass(frozen=True)
class Signals:
    """Plan of the signals that the configuration asks for. Methods with `wildcards` are inputs and parameters of rules."""

    sweep: Sweep

    @property
    def _section(self) -> SignalSection:
        return self.sweep.settings.section(SECTION)

    @property
    def runs(self) -> list[tuple[str, str]]:
        """Pairs of blade and scene with signals; without speeds those of imported blades whose runs have a fixed length."""
        pairs, scenes = self.sweep.runs_with("signal"), self.sweep.settings.scenes
        if self._section.speeds() is None:
            every = self.sweep.settings.blades
            blades = [name for name in every if not every[name].has_profiles] if self._section.imported else []
            pairs = [(blade, scene) for blade, scene in pairs if blade in blades and not scenes[scene].until_settled]
        return [(blade, scene) for blade, scene in pairs if self._section.blades == "all" or blade in self._section.blades]

    def gauges(self, wildcards: Any) -> dict[str, dict[str, Any]]:
        """Gauges of a blade as plain values; a blade given by matrices has none."""
        gauges = self._section.gauges if wildcards.blade in self.sweep.meshed_blades else {}
        return {name: to_plain(si_form(Gauge, entry)) for name, entry in gauges.items()}

    def inputs(self, wildcards: Any) -> dict[str, str]:
        """Inputs of signals, with those of gauges and of the speeds of interactions."""
        where = {"blade": wildcards.blade, "scene": wildcards.scene}
        files = {
            "prepared": paths.INTEGRATION_STAMP.format(**where),
            "model": self.sweep.contact_model(wildcards),
            "rom": self.sweep.reduced_model(wildcards),
        }
        if self.gauges(wildcards):
            whole = self.sweep.whole_blade_model(wildcards)
            files |= {"mesh": paths.MESH.format(**where), "whole": whole}
        if not self.speeds:
            files |= {"campbell": paths.CAMPBELL.format(**where), "response": paths.RESPONSE.format(**where)}
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


def signals_have_runs(settings: Settings) -> None:
    """Signals are wanted of blades that are there and of some scene, and are no longer than its runs."""
    wanted, document = settings.section(SECTION), settings.document
    if wanted.blades != "all":
        document.known(("signals", "blades"), wanted.blades, settings.designs.entries, settings.designs.document)
    speeds, key = wanted.speeds(), ("signals", wanted.key_of_speeds)
    if speeds is None:
        return
    if isinstance(speeds, list):
        for name in settings.scenes:
            slow_run_can_be_done(length_of_run(settings, name, speeds[0]), settings, key)
    signal_runs = {name: scene for name, scene in settings.scenes.items() if "signal" in scene.results}
    if not signal_runs:
        raise document.refusal(
            "speeds, though no scene that is run has signal among its results",
            f"such a scene ({', '.join(settings.scenes)} of {settings.scene_designs.document.name} are run), or no speeds",
            *key,
        )
    for name, scene in signal_runs.items():
        if scene.until_settled:
            value = f"speeds, with runs of '{name}' that end as they have settled, each in another revolution"
            raise document.refusal(value, "until: revolutions in that scene, or no speeds", *key)
        if wanted.revolutions is not None and wanted.revolutions > scene.revolutions:
            allowed = f"at most those of a run, {scene.revolutions} in '{name}'"
            raise document.refusal(f"{wanted.revolutions}", allowed, "signals", "revolutions")


EXTENSION = Extension(
    name="signals",
    section=SECTION,
    checks=(signals_have_runs,),
    targets=lambda sweep: {SIGNALS_OF_RUN: paths.run_keys(Signals(sweep).runs)},
)
