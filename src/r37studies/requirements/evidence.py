"""Evidence that a requirement is judged by: results of one blade in one scene, and how they change with what is not sure."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np
import xarray as xr

from r37core.results.datasets import overlaid
from r37core.results.limits import OF_LIMITS, reasons_beyond_limits
from r37core.results.operating_range import OperatingRange
from r37core.time_integration.status import RunStatus

from .choice import LEAST_STEP, NEAR, WIDTH

JUDGED = (
    "status",
    "diverged_revolution",
    "motion_at_end",
    "max_von_mises_inside",
    "stress_drift",
    "goodman_share_inside",
    "exit_revolution",
    "used_thickness",
    "worn_through_share",
    "share_of_time_in_contact",
    *OF_LIMITS,
)
"""Variables over the speeds that requirements are judged by."""

OF_ALL = ("lined", "yield_stress", "static_stress", "fatigue_strength")
"""Variables that are the same at all speeds."""

SCALED = ("max_von_mises_inside", "goodman_share_inside", "used_thickness")
"""Variables that an error of mesh and step scales."""

SHOWN = 0.9
"""Share of a peak that speeds beside it have at least where they show how high it is."""

HALF_FRICTION = "half the friction"
"""Look at the run that diverged soonest, which says whether friction drives it; it judges nothing."""

_ROUNDING = 1e-6


@dataclass(frozen=True)
class Evidence:
    """Results of one blade in one scene. `response`: rms with stress and wear, if computed; `campbell`: of the blade.

    `members`, `motions`: parts of the datasets of members under tolerances and of more motions. `looks`: further runs, see
    requirements.looks, each a response of JUDGED; none where none were done, for the reason in `not_looked`, which may be that
    another requirement `fails_elsewhere`. `clearance` (m): of a casing whose clearance is the same at every speed; `thickness`
    (m) of the lining; `mass` (kg); `miner_sum` of the worst run-up; NaN each where not known. `error`: relative error of stress
    and wear by mesh and step, NaN if unknown. `point_contact`: whether contact acts on points.
    """

    response: xr.Dataset
    campbell: xr.Dataset = field(default_factory=xr.Dataset, kw_only=True)
    operating: OperatingRange = field(kw_only=True)
    members: xr.Dataset | None = None
    motions: xr.Dataset | None = None
    looks: Mapping[str, xr.Dataset] = field(default_factory=dict)
    not_looked: str = ""
    fails_elsewhere: bool = False
    clearance: float = np.nan
    thickness: float = np.nan
    mass: float = np.nan
    miner_sum: float = np.nan
    error: float = 0.0
    point_contact: bool = False

    def replaced(self, response: xr.Dataset) -> Self:
        """The evidence with another response in place of its own."""
        return replace(self, response=response)

    @property
    def speeds(self) -> np.ndarray:
        """Speeds (rad/s) that were run."""
        return self.response["speed"].values[self.response["status"].values != RunStatus.NOT_RUN]

    @property
    def not_covered(self) -> str:
        """Why nothing can be said of the operating range; empty where its speeds are run."""
        first, last = self.operating.first, self.operating.last
        return "" if self.operating.is_covered(self.speeds) else f"speeds are not run from {first:.6g} to {last:.6g} rad/s"

    @property
    def gap(self) -> float:
        """Largest distance (rad/s) of neighbouring speeds in the operating range."""
        speeds = self.speeds
        overlap = np.minimum(speeds[1:], self.operating.last) - np.maximum(speeds[:-1], self.operating.first)
        return float(np.max(np.diff(speeds), where=overlap > 0.0, initial=0.0))

    @property
    def touches(self) -> bool:
        """True unless runs over the whole operating range say that the tip never touches casing or lining.

        Where the clearance changes with the speed it may touch between them.
        """
        if "share_of_time_in_contact" not in self.response or self.not_covered or np.isnan(self.clearance):
            return True
        touching = self.diverged | ~(self.response["share_of_time_in_contact"].values <= 0.0)
        return bool(np.any(touching & _spanning(self)))

    @property
    def too_coarse(self) -> str:
        """Why an interaction may be hidden between speeds; empty where none can."""
        narrow = self.gap <= WIDTH * (1.0 + _ROUNDING) or not self.touches
        return "" if narrow else f"speeds lie up to {self.gap:.3g} rad/s apart, and an interaction may be {WIDTH:g} wide"

    @property
    def operates(self) -> np.ndarray:
        """Runs in the operating range: true or false, shape (speeds,)."""
        speeds = self.response["speed"].values
        return (speeds >= self.operating.first) & (speeds <= self.operating.last)

    @property
    def divergence(self) -> str:
        """How many runs in operation diverged, and when; empty where none did."""
        soonest, count, total = soonest_divergence(self), np.count_nonzero(self.operates & self.diverged), self.operates.sum()
        if not count:
            return ""
        many = "every run" if count == total else f"{count} of {total} runs"
        if "diverged_revolution" not in soonest:
            return f"{many} diverged"
        revolutions = soonest["diverged_revolution"].values[0]
        friction = self.looks.get(HALF_FRICTION)
        ends = friction is not None and bool((friction["status"] == RunStatus.COMPLETED).all())
        driven = f"; with {HALF_FRICTION} this run ends: friction drives it" if ends else ""
        return f"{many} diverged, soonest at {soonest['speed'][0]:.5g} rad/s after {revolutions:.3g} revolutions{driven}"

    @property
    def diverged(self) -> np.ndarray:
        """Runs that diverged: true or false, shape (speeds,)."""
        return self.response["status"].values == RunStatus.DIVERGED

    def worst(self, values: np.ndarray) -> tuple[float, float]:
        """Largest of the `values`, shape (speeds,), of runs in the operating range, and its speed (rad/s).

        Where the range begins or ends between two runs, the nearest one outside counts, too.
        """
        place = np.where(_spanning(self), values, -np.inf).argmax()
        return float(values[place]), float(self.response["speed"].values[place])

    def scaled(self, factor: float | xr.DataArray) -> Self:
        """The evidence with stress, share of the Goodman line and used lining times a `factor`, or one of each speed."""
        runs = self.response
        return self.replaced(runs.assign({name: factor * runs[name] for name in SCALED if name in runs}))


def reach(evidence: Evidence, near: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How near each run in operation comes to a limit, and how near it may: between speeds, or as its stress drifts on.

    What stays below NEAR is not looked at closer. `near`, shape (speeds,): see judging.nearness.
    """
    runs = evidence.response
    may_be = np.where(near >= NEAR, peak_reach(runs["speed"].values, near), near)
    if "stress_drift" in runs:
        may_be = np.maximum(may_be, near * (1.0 + np.nan_to_num(runs["stress_drift"].values)))
    return near[evidence.operates], may_be[evidence.operates]


def peak_reach(speeds: np.ndarray, values: np.ndarray) -> np.ndarray:
    """How high each peak of positive `values` may be between ascending `speeds`, shape (speeds,); elsewhere the values.

    By the parabola of 1/value^2 through three speeds, which is that of a resonance; infinite where its top is below 0, or the
    peak falls below SHOWN on both sides: not every peak is a resonance. Where the speeds stand closer than LEAST_STEP the lower
    of the two steps up to the peak goes on.
    """
    # of a run that diverged
    values = np.minimum(values, 1e6)
    reach = values.astype(float)
    peaks = 1 + np.flatnonzero((values[1:-1] >= np.maximum(values[:-2], values[2:])) & (values[1:-1] > 0.0))
    before, after = speeds[peaks] - speeds[peaks - 1], speeds[peaks + 1] - speeds[peaks]
    low, top, high = (np.maximum(values[peaks + step], 1e-6) ** -2.0 for step in (-1, 0, 1))
    first, second = (top - low) / before, (high - top) / after
    curvature = (second - first) / (before + after)
    slope = first + curvature * before
    least = top - np.divide(slope**2, 4.0 * curvature, out=np.zeros(len(peaks)), where=curvature > 0.0)
    beside = np.maximum(values[peaks - 1], values[peaks + 1])
    is_shown = (least > 0.0) & (beside >= SHOWN * values[peaks])
    resonance = np.where(is_shown, np.maximum(least, 1e-12) ** -0.5, np.inf)
    stepped = 2.0 * values[peaks] - beside
    reach[peaks] = np.where(np.maximum(before, after) > LEAST_STEP, resonance, stepped)
    return reach


def soonest_divergence(evidence: Evidence) -> xr.Dataset:
    """The run in operation that diverged soonest, of one speed; of none where none did."""
    ended = evidence.response.isel(speed=np.flatnonzero(evidence.operates & evidence.diverged))
    lasted = ended.get("diverged_revolution", ended["speed"]).values
    return ended.isel(speed=np.argsort(np.nan_to_num(lasted, nan=np.inf), kind="stable")[:1])


def beyond_model(evidence: Evidence) -> list[str]:
    """Limits that runs in operation, and further ones, are beyond, each with the largest number; nothing where none is."""
    further = (runs for look, runs in evidence.looks.items() if look != HALF_FRICTION)
    parts = [evidence.response.isel(speed=np.flatnonzero(evidence.operates)), *further]
    runs = {
        name: np.concatenate([np.broadcast_to(part.get(name, np.nan), part.sizes["speed"]) for part in parts])
        for name in OF_LIMITS
    }
    reasons = reasons_beyond_limits(runs)
    return [f"beyond the model by {', '.join(reasons)}"] if reasons else []


def operated_alone(evidence: Evidence) -> Evidence:
    """The evidence without stress and wear of runs outside of the operating range."""
    runs = evidence.response
    kept = {
        name: runs[name].where(evidence.operates, RunStatus.COMPLETED if name == "status" else 0.0)
        for name in JUDGED
        if name in runs
    }
    return evidence.replaced(runs.assign(kept))


def lacking(evidence: Evidence, name: str) -> str:
    """Where a completed run has no number of this `name`; empty where all have."""
    completed = _spanning(evidence) & (evidence.response["status"].values == RunStatus.COMPLETED)
    speeds = evidence.response["speed"].values[completed & np.isnan(evidence.response[name].values)]
    return f"no {name} at {speeds[0]:.5g} rad/s" if len(speeds) else ""


def _spanning(evidence: Evidence) -> np.ndarray:
    """Runs in the operating range and, where it begins or ends between two, the nearest outside, shape (speeds,)."""
    speeds, ran = evidence.response["speed"].values, evidence.speeds
    below = np.max(ran, where=ran <= evidence.operating.first, initial=-np.inf)
    above = np.min(ran, where=ran >= evidence.operating.last, initial=np.inf)
    return np.isin(speeds, ran) & (speeds >= below) & (speeds <= above)


def judged_part(response: xr.Dataset) -> xr.Dataset:
    """The variables of a response that requirements are judged by."""
    return response[[name for name in (*JUDGED, *OF_ALL) if name in response]].reset_coords(drop=True)


def extended(below: xr.Dataset, above: xr.Dataset) -> xr.Dataset:
    """Runs `above`, and those of `below` at speeds that these do not reach to."""
    speeds, reached = below["speed"].values, above["speed"].values
    return overlaid(below.isel(speed=np.flatnonzero((speeds < reached.min()) | (speeds > reached.max()))), above)


def worst_of(motions: xr.Dataset) -> xr.Dataset:
    """Response whose stress and wear are the largest of all motions, of a dataset over (motion, speed)."""
    kept = judged_part(motions)
    if "motion" not in kept.dims:
        return kept
    status = kept["status"]
    diverged = (status == RunStatus.DIVERGED).any("motion")
    if "exit_revolution" in kept:
        kept = kept.assign(exit_revolution=kept["exit_revolution"].min("motion").broadcast_like(status))
    return kept.max("motion").assign(status=xr.where(diverged, RunStatus.DIVERGED, status.min("motion")))
