"""Points of a measurement, and what of a run they are compared with. Light: plain data that a rule's parameter holds."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from r37core.stress.gauge import Gauge

RMS, VALUES = "rms", "values"
WORN_DEPTH, STRAIN, TIP_TIMING = "worn_depth", "strain", "tip_timing"

GAIN = "gain"
"""Kind of a number that a measurement's simulated values are multiplied by."""

CONFIRMING = 4
"""Last designs of a calibration, at the most likely values."""


@dataclass(frozen=True)
class Points:
    """Measured values in SI units with their standard deviations, at speeds (rad/s).

    `angles` (rad) of a profile round the casing, else none; `orders`: engine order of each amplitude, 0 where the value is
    the measurement's statistic; `remark`: on the file.
    """

    speeds: tuple[float, ...]
    values: tuple[float, ...]
    deviations: tuple[float, ...]
    orders: tuple[int, ...]
    angles: tuple[float, ...] = ()
    remark: str = ""

    @classmethod
    def collected(cls, *columns: Any, angles: tuple[float, ...] = (), remark: str = "") -> Self:
        """Points of speeds, values, deviations and orders: arrays of shape (points,), or one number that all have."""
        equally_long = np.broadcast_arrays(*map(np.atleast_1d, columns))
        speeds, values, deviations, orders = (tuple(part.tolist()) for part in equally_long)
        return cls(speeds, values, deviations, orders, angles, remark)


@dataclass(frozen=True)
class Measurement:
    """A `quantity` of a blade in a scene and its `points`; `file` as it is named.

    `statistic`: rms, half_peak_to_peak or order; `speed_of`: peak, or first_above with a `limit` in SI units, where the one
    point is the speed of that on a curve over `curve_speeds` (rad/s). `probe` (rad), `gauge`: of tip timing and strain.
    """

    file: str
    blade: str
    scene: str
    quantity: str
    points: Points
    statistic: str = RMS
    tip_point: str = "leading_edge"
    probe: float = 0.0
    gauge: Gauge | None = None
    speed_of: str = VALUES
    limit: float | None = None
    curve_speeds: tuple[float, ...] = ()

    @property
    def unit(self) -> str:
        """Unit of the values."""
        return "rad s-1" if self.speed_of != VALUES else "1" if self.quantity == STRAIN else "m"

    @property
    def title(self) -> str:
        """Quantity and statistic, for tables, figures and messages."""
        if self.speed_of != VALUES:
            return (
                f"speed of the {'peak' if self.limit is None else f'first above {self.limit:g}'} of {self.quantity}{self.place}"
            )
        statistic = "engine orders" if any(self.points.orders) else self.statistic
        return self.quantity if self.quantity == WORN_DEPTH else f"{self.quantity}{self.place}, {statistic}"

    @property
    def place(self) -> str:
        """Where it was measured, but for the leading edge."""
        if self.gauge is not None:
            place = self.gauge
            return f" at chord {place.chord:g}, span {place.span:g}, {place.side} side, {np.degrees(place.angle):.3g} degrees"
        if self.quantity == TIP_TIMING:
            return f" at {np.degrees(self.probe):.4g} degrees"
        return "" if self.tip_point == "leading_edge" else " at the trailing edge"

    @property
    def run_speeds(self) -> tuple[float, ...]:
        """Speeds (rad/s) of the runs that it is compared with, ascending."""
        return tuple(sorted({*(self.curve_speeds or self.points.speeds)}))

    @property
    def wanted_orders(self) -> tuple[int, ...]:
        """Engine orders that a run keeps; 0 stands for the statistic."""
        return tuple(sorted({*self.points.orders}))

    @property
    def observes(self) -> tuple[object, ...]:
        """All that decides what is kept of a run for it."""
        wanted = self.wanted_orders, bool(self.points.angles)
        return (self.quantity, self.statistic, self.tip_point, self.probe, self.gauge, *wanted)

    def simulated(self, runs: Mapping[float, Mapping[str, np.ndarray]], name: str) -> tuple[np.ndarray, str]:
        """Values of runs, by speed (rad/s), at the points, and a remark; `name`: of this measurement's numbers in a run.

        Infinite where a run diverged. A profile is turned to where it fits best, which the remark says.
        """
        if self.speed_of != VALUES:
            curve = np.array([runs[speed][name][0] for speed in self.run_speeds])
            return np.array([feature_speed(np.array(self.run_speeds), curve, self.limit)]), self.points.remark
        if self.points.angles:
            return turned_profile(runs[self.points.speeds[0]][name], self.points)
        points = zip(self.points.speeds, self.points.orders, strict=True)
        return np.array([runs[speed][name][self.wanted_orders.index(order)] for speed, order in points]), self.points.remark


def feature_speed(speeds: np.ndarray, values: np.ndarray, limit: float | None) -> float:
    """First speed (rad/s) at which a curve passes a limit, or without one that of its largest value; infinite without any.

    Between speeds a straight line counts for the limit, and for the largest value the parabola through three speeds.
    """
    if limit is None:
        place, is_finite = int(values.argmax()), np.isfinite(values).all()
        if not is_finite or place in (0, len(values) - 1):
            return float(speeds[place]) if is_finite else np.inf
        curvature, slope, _ = np.polyfit(speeds[place - 1 : place + 2] - speeds[place], values[place - 1 : place + 2], 2)
        return float(speeds[place] - (0.5 * slope / curvature if curvature < 0.0 else 0.0))
    if not (values > limit).any():
        return np.inf
    place = int((values > limit).argmax())
    if place == 0 or not np.isfinite(values[place]):
        return float(speeds[place])
    return float(np.interp(limit, values[place - 1 : place + 1], speeds[place - 1 : place + 1]))


def turned_profile(wear: np.ndarray, points: Points) -> tuple[np.ndarray, str]:
    """A simulated wear profile (m), shape (sectors,), at the points of a measured one, turned to where it fits best.

    The remark says by how much, and whether the measured profile fits clearly better when it is read backwards.
    """
    measured, deviations, angles = (np.array(part) for part in (points.values, points.deviations, points.angles))
    if not np.isfinite(wear).all():
        return np.full(len(measured), np.inf), "the run diverged"
    turns = 2.0 * np.pi * np.arange(len(wear)) / len(wear)

    def best(sense: float) -> tuple[float, float, np.ndarray]:
        # linear interpolation on the circle, in all turns at once
        places = ((sense * angles + turns[:, None]) % (2.0 * np.pi)) * len(wear) / (2.0 * np.pi) - 0.5
        low = np.floor(places).astype(int)
        profiles = (1.0 + low - places) * wear[low % len(wear)] + (places - low) * wear[(low + 1) % len(wear)]
        misfit = (((profiles - measured) / deviations) ** 2).sum(axis=1)
        turn = int(misfit.argmin())
        return float(misfit[turn]), float(turns[turn]), profiles[turn]

    (misfit, turn, profile), (backwards, *_) = best(1.0), best(-1.0)
    remark = "; ".join(filter(None, [points.remark, f"turned by {np.degrees(turn):.3g} degrees"]))
    if backwards < 0.5 * misfit and misfit - backwards > 9.0:
        remark += "; fits better when its angles are read backwards"
    return profile, remark
