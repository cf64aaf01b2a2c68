"""Ranges of hysteresis: where the motions at a speed differ by more than each of them scatters."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import xarray as xr

from r37core.time_integration.settling import SAME, SCATTERS

from .choice import MOTIONS


@dataclass(frozen=True, eq=False)
class MotionLevels:
    """Level of the motions (MOTIONS) at ascending `speeds` (rad/s).

    `mean` (m): of the rms of the leading edge's motion, normal and tangential together, over the revolutions that count;
    `scatter` (m): standard deviation of these; both of shape (motions, speeds), NaN of a motion that diverged. `differ`, shape
    (speeds,): whether some two of the motions do.
    """

    speeds: np.ndarray
    mean: np.ndarray
    scatter: np.ndarray
    differ: np.ndarray

    @classmethod
    def averaged(cls, speeds: np.ndarray, rms: Mapping[str, np.ndarray], clearance: float) -> "MotionLevels":
        """Levels by the rms (m) of the revolutions that count, motion -> shape (speeds, revolutions); NaN after a run's end."""
        counted = [np.ma.masked_invalid(rms[motion]) for motion in MOTIONS]
        mean = np.array([part.mean(axis=1).filled(np.nan) for part in counted])
        scatter = np.array([part.std(axis=1).filled(np.nan) for part in counted])
        return cls(np.asarray(speeds), mean, scatter, motions_differ(mean, scatter, clearance))

    @classmethod
    def read(cls, pair: xr.Dataset) -> "MotionLevels":
        """Levels of one blade and scene of second_motions.nc."""
        mean, scatter = (pair[f"motion_{name}"].transpose("motion", "speed").values for name in ("mean", "scatter"))
        return cls(pair["speed"].values, mean, scatter, pair["differ"].values > 0.0)

    @property
    def high(self) -> np.ndarray:
        """Place of the largest motion at each speed, shape (speeds,)."""
        return np.argmax(np.nan_to_num(self.mean, nan=-1.0), axis=0)

    @property
    def low(self) -> np.ndarray:
        """Place of the smallest motion at each speed, shape (speeds,)."""
        return np.argmin(np.nan_to_num(self.mean, nan=np.inf), axis=0)

    def ranges(self) -> list[slice]:
        """Places of the speeds of each range of hysteresis: neighbours at which motions differ."""
        differ = np.concatenate([[False], self.differ, [False]])
        firsts, ends = np.flatnonzero(~differ[:-1] & differ[1:]), np.flatnonzero(differ[:-1] & ~differ[1:])
        return [slice(int(first), int(end)) for first, end in zip(firsts, ends, strict=True)]

    def worst(self, part: slice) -> int:
        """Place of the speed in a range at which the largest motion is most above the smallest."""
        places = np.arange(len(self.speeds))[part]
        ratio = self.mean[self.high[part], places] / self.mean[self.low[part], places]
        return int(places[np.argmax(np.nan_to_num(ratio))])


def motions_differ(mean: np.ndarray, scatter: np.ndarray, clearance: float) -> np.ndarray:
    """Whether some two motions differ at each speed, shape (speeds,), by their `mean` and `scatter` (m); see MotionLevels.

    They do where their means differ by more than SCATTERS of their common standard deviation and by more than SAME, and the
    larger one is above the `clearance` (m): within it the blade is quiet, as in settling.motion_at_end.
    """
    differ = np.zeros(mean.shape[1], dtype=bool)
    for first, second in combinations(range(len(mean)), 2):
        common = np.sqrt(0.5 * (scatter[first] ** 2 + scatter[second] ** 2))
        larger = np.maximum(mean[first], mean[second])
        differ |= (np.abs(mean[first] - mean[second]) > np.maximum(SCATTERS * common, SAME * larger)) & (larger > clearance)
    return differ
