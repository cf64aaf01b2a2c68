"""The plan of measurements and of a calibration: what is compared, what is run for it, and where it lies."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from r37core.base.io import Named
from r37core.base.plain import to_plain
from r37core.base.varied_number import BLADE, SCENE, VariedNumber
from r37core.config import ConfigError, Settings
from r37core.config.changed_numbers import ImpossibleValueError, changed_pair, check_known, nominal_value, scene_numbers
from r37core.config.declaring import si_form
from r37core.config.messages import single_line
from r37core.config.section import ExtensionSection, plain
from r37core.config.settings import FARTHEST
from r37core.config.spread import SpreadEntry
from r37core.plans import paths
from r37core.plans.carried import Carried
from r37core.plans.extension import Extension, Figure, Panel
from r37core.plans.extent import Pair
from r37core.plans.structure_plan import Structure
from r37core.plans.sweep_plan import Sweep
from r37core.stress.gauge import Gauge
from r37core.surrogate.gaussian_processes import SearchPackageMissing, library

from .points import RMS, STRAIN, TIP_TIMING, VALUES, WORN_DEPTH, Measurement
from .section import CALIBRATE, MEASURED, CalibrateSection, MeasurementSection

OBSERVED = "<results>/{blade}/{scene}/observed.json"
TABLE = "<results>/measured.csv"
DATASET, NUMBERS = "<results>/calibration.nc", "<results>/calibration.csv"
FOLDER = "<results>/calibration"
"""Folder of the draws, and of scenes with the best values."""

_LENGTH = VariedNumber(SCENE, "lining.contact_length_m")

NEAR, _FEWEST = 0.05, 5
"""About a speed that was measured in place of a curve: how far speeds of the sweep are run, and how many there are at least."""


@dataclass(frozen=True)
class Measured:
    """Measurements that `settings` ask for. Methods with `wildcards` are inputs and parameters of rules."""

    settings: Settings

    @cached_property
    def all(self) -> dict[str, Measurement]:
        """Measurements by their names. Raises ConfigError for a file that cannot be used."""
        return {f"m{number}": self._read(number, each) for number, each in enumerate(self.settings.section(MEASURED))}

    @cached_property
    def pairs(self) -> list[Pair]:
        """Blades and scenes that have measurements, in the order of the run."""
        measured = {(each.blade, each.scene) for each in self.settings.section(MEASURED)}
        return [pair for pair in self.settings.speed_plans if pair in measured]

    def plain_measurements(self, wildcards: Any) -> dict[str, Any]:
        """Measurements of a blade in a scene, as plain values."""
        return to_plain(self.pair_measurements((wildcards.blade, wildcards.scene)))

    def pair_measurements(self, pair: Pair) -> dict[str, Measurement]:
        """Measurements of a blade in a scene, by their names."""
        return {name: each for name, each in self.all.items() if (each.blade, each.scene) == pair}

    def inputs(self, wildcards: Any) -> dict[str, str]:
        """Files that the runs of a blade and scene start from."""
        sweep, pair = Sweep(self.settings), (wildcards.blade, wildcards.scene)
        quantities = [each.quantity for each in self.pair_measurements(pair).values()]
        where = {"blade": wildcards.blade, "scene": wildcards.scene}
        files = {"prepared": paths.fill(paths.INTEGRATION_STAMP, **where), "model": sweep.contact_model(wildcards)}
        if TIP_TIMING in quantities:
            files["rom"] = sweep.reduced_model(wildcards)
        if STRAIN in quantities:
            files |= {"mesh": paths.fill(paths.MESH, **where), "whole": Structure(self.settings).whole_blade_model(wildcards)}
        return files

    def choice(self, wildcards: Any) -> dict[str, Any]:
        """Time integration of a run: that of the sweep."""
        return to_plain(self.settings.integration_choice(wildcards.blade, wildcards.scene, 0.0))

    def _read(self, number: int, entry: MeasurementSection) -> Measurement:
        # reading tables takes pandas, which a run without measurements does not load
        from .file import MeasurementError, read_points

        settings, document, path = self.settings, self.settings.documents.config, ("measured", number)
        names = {"blade": settings.blade_names, "scene": settings.scene_names}
        for key, known in names.items():
            if (name := getattr(entry, key)) not in known:
                raise document.refusal((*path, key), f"'{name}'", f"one that is run ({', '.join(known)})")
        scene = settings.scenes[entry.scene].scene
        if scene.rotor or settings.structure.coriolis:
            raise document.refusal(
                (*path, "scene"), f"'{entry.scene}', a rotor or with Coriolis forces", "a scene of one blade"
            )
        if entry.quantity == WORN_DEPTH and scene.lining is None:
            raise document.refusal((*path, "quantity"), f"{WORN_DEPTH} in '{entry.scene}', without lining", "a scene with one")
        gauge = self._gauge(entry, path)
        file = Path(entry.file) if Path(entry.file).is_absolute() else settings.root / entry.file
        try:
            points, speeds = read_points(file, entry)
        except MeasurementError as error:
            raise document.error((*path, error.key), f"{entry.file}: {error}") from None
        if entry.speed_of != VALUES and not speeds:
            # the sweep's speeds about it
            near = [
                each
                for each in settings.speed_plans[entry.blade, entry.scene].certain
                if abs(each / points.values[0] - 1) < NEAR
            ]
            if len(near) < _FEWEST:
                allowed = f"speeds of the sweep, {_FEWEST} or more within {NEAR:.0%} of {points.values[0]:g} rad/s"
                raise document.refusal((*path, "speed_of"), f"{entry.speed_of} with {len(near)} of them", allowed)
            speeds = tuple(near)
        fastest, highest = max((*points.speeds, *speeds)), FARTHEST * settings.structure.maximum_speed_rad_s
        if fastest > highest:
            allowed = f"up to {highest:g}, {FARTHEST:g} times structure.maximum_speed_rad_s; rpm in a column ..._rpm"
            raise document.refusal((*path, "file"), f"{fastest:g} rad/s in {entry.file}", allowed)
        return Measurement(
            file=entry.file, blade=entry.blade, scene=entry.scene, quantity=entry.quantity, points=points,
            statistic=RMS if entry.quantity == WORN_DEPTH else entry.statistic, tip_point=entry.tip_point,
            probe=np.radians(entry.probe_deg or 0.0), gauge=gauge, speed_of=entry.speed_of, limit=entry.limit,
            curve_speeds=speeds,
        )  # fmt: skip

    def _gauge(self, entry: MeasurementSection, path: tuple[str | int, ...]) -> Gauge | None:
        section = entry.gauge
        if isinstance(section, str):
            known = self.settings.config.signals.gauges  # type: ignore[attr-defined]
            if section not in known:
                allowed = f"one of signals.gauges ({', '.join(known) or 'none'}), or a place: chord, span, side, angle_deg"
                raise self.settings.documents.config.refusal((*path, "gauge"), f"'{single_line(section)}'", allowed)
            section = known[section]
        if section is not None and entry.blade not in Structure(self.settings).meshed_blades:
            refusal = f"a gauge on '{entry.blade}', which has no mesh"
            raise self.settings.documents.config.refusal((*path, "gauge"), refusal, "a blade with one")
        return None if section is None else si_form(Gauge, section)


@dataclass(frozen=True)
class Calibrated:
    """Plan of the calibration that `settings` ask for."""

    settings: Settings

    @property
    def section(self) -> CalibrateSection:
        """Section of config.yaml."""
        section = self.settings.section(CALIBRATE)
        assert section is not None
        return section

    @cached_property
    def spreads(self) -> dict[VariedNumber, SpreadEntry]:
        """Distribution of each number before; that of the contact length as a rub test gives it."""
        section, pairs = self.section, self.settings.made(Measured).pairs
        linings = [lining for _, scene in pairs if (lining := self.settings.scenes[scene].scene.lining)]
        if section.rub_test is None:
            return section.spreads
        # tables take pandas
        from r37core.rub_tests.lining_fit import fit_lining
        from r37core.rub_tests.rig_table import read_rub_test

        document, path = self.settings.documents.config, (CALIBRATE.name, "rub_test")
        if not linings or linings[0].published or _LENGTH in section.spreads:
            allowed = f"a measured scene with a lining by contact_length_m, and no distribution of {_LENGTH.key}"
            raise document.refusal(path, section.rub_test, allowed)
        try:
            length = fit_lining(read_rub_test(self.settings.root / section.rub_test, {}), linings[0]).contact_length
        except ConfigError as error:
            raise document.error(path, str(error)) from None
        low, high = length.range_95
        if not 0.0 < low < high < np.inf:
            raise document.refusal(path, f"{section.rub_test}, which does not tell the contact length", "more points")
        return {_LENGTH: SpreadEntry(log_between=[low, high]), **section.spreads}

    @cached_property
    def nominal(self) -> list[float]:
        """Value in the configuration of each number, which all measured blades and scenes that have it share."""
        numbers, settings, document = self.spreads, self.settings, self.settings.documents.config
        pairs, values = settings.made(Measured).pairs, []
        scenes = {scene: scene_numbers(settings.scene_designs.entries[scene]) for _, scene in pairs}
        check_known(numbers, (key for known in scenes.values() for key in known), document, (CALIBRATE.name,))
        for number in numbers:
            path = (CALIBRATE.name, number.section, number.key)
            try:
                known = {nominal_value(number, settings.blades[blade], scenes[scene]) for blade, scene in pairs} - {None}
            except ValueError as error:
                raise document.refusal(path, str(error), "other numbers") from None
            if len(known) != 1:
                which = (
                    f"{number.key} that no measured blade or scene has" if not known else f"{number.key} with several values"
                )
                raise document.refusal(path, which, "a number with one value in what was measured")
            values.append(float(next(iter(known))))  # type: ignore[arg-type]
        return values

    def budget(self) -> list[int]:
        """Number of designs of each round."""
        entry = self.section
        more = range(entry.first, entry.runs, entry.batch)
        return [entry.first, *(min(entry.batch, entry.runs - done) for done in more)]

    def inputs(self) -> dict[str, list[str]]:
        """Files that the designs start from: lists, of each blade and scene."""
        measured = self.settings.made(Measured)
        files = [measured.inputs(Named(blade=pair[0], scene=pair[1])) for pair in measured.pairs]
        return {name: [each.get(name, each["model"]) for each in files] for name in sorted(set().union(*files))}

    def made_of(self, wildcards: Any) -> Any:
        """All that the designs follow from beside the files, as plain values."""
        measured, settings = self.settings.made(Measured), self.settings
        scenes = [settings.scene_designs.entries[scene].model_dump() for _, scene in measured.pairs]
        choices = [measured.choice(Named(blade=blade, scene=scene)) for blade, scene in measured.pairs]
        spreads = {number.name: plain(spread) for number, spread in self.spreads.items()}
        return [scenes, choices, to_plain(measured.all), self.section.model_dump(), spreads, self.nominal]

    def carried(self, wildcards: Any) -> Carried:
        """The settings, of which designs are made."""
        return Carried(self.settings)

    def ends(self) -> Iterator[tuple[VariedNumber, dict[VariedNumber, float]]]:
        """Each end of each number's range."""
        for (number, spread), value in zip(self.spreads.items(), self.nominal, strict=True):
            for end in spread.ends(value):
                yield number, {number: end}


def can_be_compared(settings: Settings) -> None:
    """Files of measurements can be read, and are of blades and scenes that are run."""
    _ = settings.made(Measured).all


def can_be_calibrated(settings: Settings) -> None:
    """There are measurements, the numbers are there and possible over their ranges, and the library is installed."""
    if settings.section(CALIBRATE) is None:
        return
    document, calibrated = settings.documents.config, settings.made(Calibrated)
    if not settings.section(MEASURED):
        raise document.refusal((CALIBRATE.name,), "no measurement", "measured: with a file beside it")
    measured = settings.made(Measured)
    strained = [each for each in measured.all.values() if each.quantity == STRAIN]
    if strained and any(number.kind == BLADE for number in calibrated.spreads):
        raise document.refusal((CALIBRATE.name, "of_blades"), "numbers of blades with a gauge", "of_scenes, or no gauge")
    for blade, scene in measured.pairs:
        for number, values in calibrated.ends():
            try:
                numbers = scene_values(settings, scene, values)
                changed_pair(settings.blades[blade], settings.scene_designs.entries[scene], numbers)
            except (ConfigError, ImpossibleValueError) as error:
                path = (CALIBRATE.name, number.section, number.key)
                raise document.error(path, f"at the end of its range: {error}; or a narrower range") from None
    try:
        library()
    except SearchPackageMissing as error:
        raise document.error((CALIBRATE.name,), str(error)) from None


def scene_values(settings: Settings, scene: str, values: Mapping[VariedNumber, float]) -> dict[VariedNumber, float]:
    """The values of those numbers that a scene has, and of blades."""
    known = scene_numbers(settings.scene_designs.entries[scene])
    return {number: value for number, value in values.items() if number.kind == BLADE or number.key in known}


def _once(sweep: Sweep, section: ExtensionSection[Any] = MEASURED) -> paths.Wildcards:
    return [{}] if sweep.settings.section(section) else []


def simulations(settings: Settings) -> dict[Pair, int]:
    """Largest number of simulations of designs, by blade and scene."""
    if settings.section(CALIBRATE) is None:
        return {}
    measured, runs = settings.made(Measured), settings.made(Calibrated).section.runs
    several = {pair: measured.pair_measurements(pair).values() for pair in measured.pairs}
    return {pair: runs * len({speed for each in own for speed in each.run_speeds}) for pair, own in several.items()}


MEASUREMENTS = Extension(
    name="measured",
    section=MEASURED,
    checks=(can_be_compared,),
    targets=lambda sweep: {OBSERVED: paths.run_keys(sweep.settings.made(Measured).pairs), TABLE: _once(sweep)},
    offers={"measured": TABLE},
    figures=(
        Figure(
            rule="measured_figure",
            name="measured_{blade}__{scene}",
            runs=lambda sweep: paths.run_keys(sweep.settings.made(Measured).pairs),
            draw="measured.figures.draw_measured",
            files={"table": TABLE},
            offered=("members",),
            label="measurement",
            caption="Blade {blade} in scene {scene}: measured values with two standard deviations, and what simulations of "
            "the same speeds give, with theirs by mesh, step and 0.1% of friction.",
        ),
    ),
    panel=Panel(TABLE, "measured.panel.contents", "measured/panel.js"),
    closing="measured.panel.closing",
)
CALIBRATION = Extension(
    name="calibrate",
    section=CALIBRATE,
    checks=(can_be_calibrated,),
    members=simulations,
    targets=lambda sweep: dict.fromkeys((DATASET, NUMBERS, FOLDER), _once(sweep, CALIBRATE)),
    figures=(
        Figure(
            rule="calibration_figure",
            name="calibration",
            runs=lambda sweep: _once(sweep, CALIBRATE),
            draw="measured.figures.draw_calibration",
            files={"calibration": DATASET},
            label="calibration",
            caption="Left: each number over its distribution before, 0 to 1; thick line and thin line: 68 and 95% of what the "
            "measurements leave possible, point: best. Right: each measured point and the simulated range.",
            category="Calibration",
        ),
    ),
    closing="measured.panel.closing_of_calibration",
)
EXTENSIONS = (MEASUREMENTS, CALIBRATION)
