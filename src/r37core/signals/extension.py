"""Time signals as an extension: what config.yaml says of them, of which blades and scenes, at which speeds, from what."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Discriminator, Field, Tag, model_validator

from r37core.base.plain import to_plain
from r37core.config import Settings, si_fields, si_form
from r37core.config.cross_checks import slow_run_can_be_done
from r37core.config.declaring import declared_by
from r37core.config.section import AllOrNames, ExtensionSection, LeftOut, Name, Rpm, Section, Speed, Unique, refused
from r37core.config.speed_choice import length_of_run
from r37core.config.speed_section import refuse_both_units
from r37core.plans import paths
from r37core.plans.extension import Extension
from r37core.plans.structure_plan import Imported
from r37core.plans.sweep_plan import Sweep

from .gauge import Gauge

SignalSpeeds = Annotated[
    Annotated[Literal["interactions"], Tag("word")] | Annotated[Unique[Speed], Tag("speeds")],
    Discriminator(lambda value: "speeds" if isinstance(value, list) else "word"),
]
Degrees = Annotated[float, Field(ge=0, lt=360)]


def _each_probe_once(probes: list[float]) -> list[float]:
    for number, probe in enumerate(probes):
        if probe in probes[:number]:
            raise refused((number,), f"a probe at {probe:g} degrees twice", "each angle once")
    return probes


@declared_by(Gauge)
class GaugeEntry(Section):
    """A strain gauge on the blade's surface."""


class SignalSection(Section):
    """Kept signals; without speeds those of imported blades alone."""

    imported: bool = Field(
        default=True, description="Signals of imported blades at the speeds of interactions, where no speeds are named"
    )
    blades: AllOrNames = Field(default="all", description="Blades with signals")
    speeds_rad_s: SignalSpeeds | LeftOut = Field(
        default=None, description="Speeds with signals; interactions: the peak speeds in summary.csv; each other speed is a run"
    )
    speeds_rpm: Unique[Rpm] | LeftOut = Field(default=None, description="The same speeds in revolutions per minute")
    revolutions: Annotated[int, Field(ge=1, le=20000)] | LeftOut = Field(
        default=None, description="Revolutions kept at the end; all without it"
    )
    gauges: dict[Name, GaugeEntry] = Field(default={}, description="Strain gauges by name")
    probes_deg: Annotated[list[Degrees], AfterValidator(_each_probe_once)] = Field(
        default=[], description="Casing angles of tip-timing probes, towards growing theta"
    )

    @model_validator(mode="after")
    def _has_speeds(self) -> SignalSection:
        if self.speeds_rad_s is not None and self.speeds_rpm is not None:
            refuse_both_units("speeds_rad_s", "speeds_rpm")
        for key in ("gauges", "probes_deg"):
            if getattr(self, key) and self.speeds() is None:
                raise refused((key,), f"{key} without speeds", "speeds_rad_s beside them")
        return self

    @property
    def key_of_speeds(self) -> str:
        """The key that speeds are given with."""
        return "speeds_rad_s" if self.speeds_rpm is None else "speeds_rpm"

    def speeds(self) -> list[float] | Literal["interactions"] | None:
        """Speeds (rad/s), ascending, or the word for those of interactions; None where none are named."""
        speeds = si_fields(self).get("speeds")
        return sorted(speeds) if speeds else "interactions" if self.speeds_rad_s else None


SECTION = ExtensionSection("signals", SignalSection, SignalSection())

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
        """Pairs of blade and scene with signals; without speeds those of imported blades whose runs have a fixed length."""
        pairs, scenes = self.sweep.runs_with("signal"), self.sweep.settings.scenes
        if self._section.speeds() is None:
            blades = self.imported.blades if self._section.imported else []
            pairs = [(blade, scene) for blade, scene in pairs if blade in blades and not scenes[scene].until_settled]
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
        if not self.speeds:
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
        **paths.pictures("contact_force_{blade}__{scene}", runs),
    }


def signals_have_runs(settings: Settings) -> None:
    """Signals are wanted of blades that are there and of some scene, and are no longer than its runs."""
    wanted, documents = settings.section(SECTION), settings.documents
    if wanted.blades != "all":
        documents.known(("signals", "blades"), wanted.blades, settings.designs.entries, documents.blades)
    speeds, key = wanted.speeds(), ("signals", wanted.key_of_speeds)
    if speeds is None:
        return
    if isinstance(speeds, list):
        for name in settings.scenes:
            slow_run_can_be_done(length_of_run(settings, name, speeds[0]), settings, key)
    signal_runs = {name: scene for name, scene in settings.scenes.items() if "signal" in scene.results}
    if not signal_runs:
        raise documents.config.refusal(
            key,
            "speeds, though no scene that is run has signal among its results",
            f"such a scene ({', '.join(settings.scenes)} of {documents.scenes.name} are run), or no speeds",
        )
    for name, scene in signal_runs.items():
        if scene.until_settled:
            value = f"speeds, with runs of '{name}' that end as they have settled, each in another revolution"
            raise documents.config.refusal(key, value, "until: revolutions in that scene, or no speeds")
        if wanted.revolutions is not None and wanted.revolutions > scene.revolutions:
            allowed = f"at most those of a run, {scene.revolutions} in '{name}'"
            raise documents.config.refusal(("signals", "revolutions"), f"{wanted.revolutions}", allowed)


_CAPTIONS = {
    "spectrogram": (
        "Blade {blade} in scene {scene}: engine orders of the leading edge's motion and of strain gauges over the revolutions "
        "since the start, at each speed; Hann windows of eight revolutions."
    ),
    "orders": (
        "Blade {blade} in scene {scene}: amplitude of the strongest whole engine orders over the revolutions since the "
        "start, at each speed. Beside them, where there are probes: the leading edge's displacement that tip timing tells."
    ),
    "contact_force": (
        "Blade {blade} in scene {scene}: normal force on the tip, all contact nodes together, over the casing angle of its "
        "leading edge, at each speed. Grey: clearance of the undeformed leading edge, which lobes make smaller."
    ),
}
"""Kind of figure -> what is seen in it."""

EXTENSION = Extension(
    name="signals",
    section=SECTION,
    checks=(signals_have_runs,),
    simulated=simulated,
    targets=targets,
    captions=_CAPTIONS,
    closing="signals.dataset.closing",
)
