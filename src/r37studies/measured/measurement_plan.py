"""Measurements of a configuration, checked, and the runs at their speeds."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from r37core.config import ConfigError, Settings
from r37core.config.cross_checks import slow_run_can_be_done
from r37core.config.declaring import si_form
from r37core.config.messages import single_line
from r37core.config.settings import FARTHEST, length_of_run
from r37core.plans import paths
from r37core.plans.extent import Pair
from r37core.plans.sweep_plan import Sweep
from r37core.stress.gauge import Gauge

from .points import RMS, STRAIN, TIP_TIMING, VALUES, WORN_DEPTH, Measurement
from .section import CALIBRATE, MEASURED, MeasurementError, MeasurementSection

NEAR, _FEWEST = 0.05, 5
"""About a speed that was measured in place of a curve: how far speeds of the sweep are run, and how many there are at least."""


@dataclass(frozen=True)
class Measured:
    """Measurements that `settings` ask for."""

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

    def pair_measurements(self, pair: Pair) -> dict[str, Measurement]:
        """Measurements of a blade in a scene, by their names."""
        return {name: each for name, each in self.all.items() if (each.blade, each.scene) == pair}

    def inputs(self, wildcards: Any) -> dict[str, str]:
        """Files that the runs of a blade and scene start from."""
        sweep, where = Sweep(self.settings), {"blade": wildcards.blade, "scene": wildcards.scene}
        quantities = [each.quantity for each in self.pair_measurements((wildcards.blade, wildcards.scene)).values()]
        files = {"prepared": paths.INTEGRATION_STAMP.format(**where), "model": sweep.contact_model(wildcards)}
        if TIP_TIMING in quantities:
            files["rom"] = sweep.reduced_model(wildcards)
        if STRAIN in quantities:
            files |= {"mesh": paths.MESH.format(**where), "whole": Sweep(self.settings).whole_blade_model(wildcards)}
        return files

    def _read(self, number: int, entry: MeasurementSection) -> Measurement:
        # reading tables takes pandas, which a run without measurements does not load
        from .file import read_points

        settings, document = self.settings, self.settings.document

        def refusal(key: str, value: str, allowed: str) -> ConfigError:
            return document.refusal(value, allowed, MEASURED.name, number, key)

        for key, known in {"blade": settings.blade_names, "scene": settings.scene_names}.items():
            if (name := getattr(entry, key)) not in known:
                raise refusal(key, f"'{name}'", f"one that is run ({', '.join(known)})")
        scene, gauge = settings.scenes[entry.scene].scene, entry.gauge
        if scene.rotor:
            raise refusal("scene", f"'{entry.scene}', a rotor", "a scene of one blade")
        if entry.quantity == WORN_DEPTH and scene.lining is None:
            raise refusal("quantity", f"{WORN_DEPTH} in '{entry.scene}', without lining", "a scene with one")
        if isinstance(gauge, str):
            gauges = settings.config.signals.gauges  # type: ignore[attr-defined]
            if gauge not in gauges:
                allowed = f"one of signals.gauges ({', '.join(gauges) or 'none'}), or a place: chord, span, side, angle_deg"
                raise refusal("gauge", f"'{single_line(gauge)}'", allowed)
            gauge = gauges[gauge]
        if gauge is not None and entry.blade not in Sweep(settings).meshed_blades:
            raise refusal("gauge", f"a gauge on '{entry.blade}', which has no mesh", "a blade with one")
        try:
            points, speeds = read_points(settings.root / entry.file, entry)
        except MeasurementError as error:
            raise document.error((MEASURED.name, number, error.key), f"{entry.file}: {error}") from None
        if entry.speed_of != VALUES and not speeds:
            (speed,), certain = points.values, settings.speed_plans[entry.blade, entry.scene].certain
            speeds = tuple(each for each in certain if abs(each / speed - 1) < NEAR)
            if len(speeds) < _FEWEST:
                allowed = f"speeds of the sweep, {_FEWEST} or more within {NEAR:.0%} of {speed:g} rad/s"
                raise refusal("speed_of", f"{entry.speed_of} with {len(speeds)} of them", allowed)
        fastest, highest = max((*points.speeds, *speeds)), FARTHEST * settings.structure.maximum_speed_rad_s
        if fastest > highest:
            allowed = f"up to {highest:g}, {FARTHEST:g} times structure.maximum_speed_rad_s; rpm in a column ..._rpm"
            raise refusal("file", f"{fastest:g} rad/s in {entry.file}", allowed)
        slowest = length_of_run(settings, entry.scene, min((*points.speeds, *speeds)))
        slow_run_can_be_done(slowest, settings, (MEASURED.name, number, "file"))
        samples = settings.integration_choice(entry.blade, entry.scene).samples_per_revolution
        if 2 * (order := max(points.orders)) > samples:
            raise refusal("engine_order", f"{order}", f"up to half of the {samples} samples of a revolution at this level")
        if entry.gain and settings.section(CALIBRATE) is None:
            raise refusal("gain", "a gain and no calibrate", "both, or none")
        return Measurement(
            **entry.model_dump(include={"file", "blade", "scene", "quantity", "tip_point", "speed_of", "limit"}),
            points=points,
            statistic=RMS if entry.quantity == WORN_DEPTH else entry.statistic,
            probe=np.radians(entry.probe_deg or 0.0),
            gauge=None if gauge is None else si_form(Gauge, gauge),
            curve_speeds=speeds,
        )
