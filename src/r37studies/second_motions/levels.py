"""Level of each motion over the speeds of its sweep, and where motions differ."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import numpy as np
import xarray as xr
from scipy.ndimage import find_objects, label

from r37core.base.io import atomic_write, readable
from r37core.time_integration.settling import SAME, SCATTERS
from r37core.time_integration.speed_file import read_speed
from r37core.time_integration.status import RunStatus

from .choice import MOTIONS, REST


def write_levels(files: Sequence[Path], speeds: Sequence[float], clearance: float, worn: bool, file: Path | str) -> None:
    """Write mean and scatter of the rms at all speeds (rad/s, ascending) of a sweep, from the files of each.

    `clearance` (m): of the scene; `worn`: whether the sweep carries a worn lining.
    """
    counted = []
    for each in files:
        run = read_speed(each)
        # of the revolutions in the run's statistic; NaN of one that diverged, and where it ended before there were as many
        rms = np.full(int(run["statistic_revolutions"]), np.nan)
        if int(run["status"]) == RunStatus.COMPLETED:
            last = run["revolution_rms"][: int(run["statistic_end"])][-len(rms) :]
            rms[len(rms) - len(last) :] = last
        counted.append(rms)
    known = np.ma.masked_invalid(counted)
    levels = {"mean": known.mean(axis=1).filled(np.inf), "scatter": known.std(axis=1).filled(0.0)}
    with atomic_write(file) as partial:
        np.savez(partial, allow_pickle=False, speed=speeds, clearance=clearance, worn=worn, **levels)


@dataclass(frozen=True, eq=False)
class MotionLevels:
    """Level of the motions (MOTIONS) at ascending `speeds` (rad/s).

    `mean` (m): of the rms of the leading edge's motion, normal and tangential together, over the revolutions that count,
    infinite of a motion that diverged; `scatter` (m): standard deviation of these; both of shape (motions, speeds). `compared`:
    places of the motions that are compared, all but that from rest where the others have a worn lining. `differ`, shape
    (speeds,): whether some two of these do.
    """

    speeds: np.ndarray
    mean: np.ndarray
    scatter: np.ndarray
    compared: np.ndarray
    differ: np.ndarray

    @classmethod
    def read(cls, pair: xr.Dataset) -> "MotionLevels":
        """Levels of one blade and scene of second_motions.nc."""
        mean, scatter = (pair[f"motion_{name}"].transpose("motion", "speed").values for name in ("mean", "scatter"))
        compared, differ = np.flatnonzero(pair["compared"].values > 0.0), pair["differ"].values > 0.0
        return cls(pair["speed"].values, np.nan_to_num(mean, nan=np.inf), np.nan_to_num(scatter), compared, differ)

    @property
    def high(self) -> np.ndarray:
        """Place of the largest of the compared motions at each speed, shape (speeds,)."""
        return self.compared[np.argmax(self.mean[self.compared], axis=0)]

    @property
    def low(self) -> np.ndarray:
        """Place of the smallest of the compared motions at each speed, shape (speeds,)."""
        return self.compared[np.argmin(self.mean[self.compared], axis=0)]

    def ranges(self) -> list[slice]:
        """Places of the speeds of each range of hysteresis: neighbours at which motions differ."""
        return [part for (part,) in find_objects(label(self.differ)[0])] if self.differ.any() else []

    def worst(self, part: slice) -> int:
        """Place of the speed in a range at which the largest motion is most above the smallest."""
        places = np.arange(len(self.speeds))[part]
        smallest = np.maximum(self.mean[self.low[part], places], np.finfo(float).tiny)
        return int(places[np.argmax(self.mean[self.high[part], places] / smallest)])


def motions_differ(mean: np.ndarray, scatter: np.ndarray, clearance: float) -> np.ndarray:
    """True at speeds where some two motions differ, shape (speeds,), by their `mean` and `scatter` (m); see MotionLevels.

    They do where their means differ by more than SCATTERS of their common standard deviation and by more than SAME, and the
    larger one is above the `clearance` (m): within it the blade is quiet, as in settling.motion_at_end. One that diverged
    differs from one that did not.
    """
    differ = np.zeros(mean.shape[1], dtype=bool)
    for first, second in combinations(range(len(mean)), 2):
        diverged = np.isinf(mean[[first, second]])
        both = np.where(diverged.any(axis=0), 0.0, mean[[first, second]])
        common, larger = np.sqrt(0.5 * (scatter[first] ** 2 + scatter[second] ** 2)), both.max(axis=0)
        apart = np.abs(both[0] - both[1]) > np.maximum(SCATTERS * common, SAME * larger)
        differ |= (apart & (larger > clearance)) | (diverged[0] != diverged[1])
    return differ


def read_levels(files: Sequence[Path | str]) -> MotionLevels:
    """Levels of the motions of a blade and scene, from the file of each, in the order of MOTIONS."""
    sweeps = []
    for file in files:
        with readable(file), np.load(file) as stored:
            sweeps.append(dict(stored))
    first, (mean, scatter) = sweeps[0], (np.array([each[name] for each in sweeps]) for name in ("mean", "scatter"))
    compared = np.flatnonzero([not (first["worn"] and motion == REST) for motion in MOTIONS])
    differ = motions_differ(mean[compared], scatter[compared], float(first["clearance"]))
    return MotionLevels(first["speed"], mean, scatter, compared, differ)
