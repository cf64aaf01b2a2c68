"""Files of the sweeps and dwells of one blade and scene."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import Variable, dataset_of
from r37core.base.io import atomic_write, readable
from r37core.results.variables import AXES, OF_KIND
from r37core.time_integration.carrying import CarriedMotion
from r37core.time_integration.speed_file import read_speed
from r37core.time_integration.status import RunStatus

from .choice import MOTIONS
from .dwelling import Dwell
from .ranges import MotionLevels
from .sweeping import CARRIED, END_WEAR, carried_of


class SweptStates:
    """Motions at the end of each speed of a sweep, from its file; `speeds` (rad/s) ascend.

    `rms` (m): of the revolutions that count, shape (speeds, revolutions); `clearance` (m): of the scene; `worn`: whether the
    sweep carries a worn lining.
    """

    def __init__(self, file: Path | str):
        with readable(file), np.load(file) as stored:
            self._arrays = dict(stored)
            self.speeds, self.rms, self.clearance = (self._arrays[name] for name in ("speed", "revolution_rms", "clearance"))
        self.worn = END_WEAR in self._arrays

    def motion(self, place: int) -> CarriedMotion | None:
        """Motion at the end of the speed at this place; None where it diverged."""
        names = ("status", *CARRIED, *([END_WEAR] if self.worn else []))
        return carried_of({name: self._arrays[name][place] for name in names})


def write_states(files: Sequence[Path], speeds: Sequence[float], clearance: float, file: Path | str) -> None:
    """Write the states of all speeds (rad/s, ascending) of a sweep, from the files of each, and the scene's `clearance` (m).

    Wear of carried linings is in single precision.
    """
    runs = [read_speed(each) for each in files]
    counted = [_counted(run) for run in runs]
    arrays = {name: np.array([run[name] for run in runs]) for name in ("status", *CARRIED)}
    if END_WEAR in runs[0]:
        arrays[END_WEAR] = np.array([run[END_WEAR] for run in runs], dtype=np.float32)
    with atomic_write(file) as partial:
        arrays |= {"speed": np.array(speeds), "revolution_rms": np.array(counted), "clearance": np.array(clearance)}
        np.savez_compressed(partial, allow_pickle=False, **arrays)


def _counted(run: Mapping[str, np.ndarray]) -> np.ndarray:
    """Rms (m) of the revolutions in a run's statistic, shape (revolutions,); NaN of one that diverged."""
    end, count = int(run["statistic_end"]), int(run["statistic_revolutions"])
    if int(run["status"]) != RunStatus.COMPLETED:
        return np.full(count, np.nan)
    last = run["revolution_rms"][:end][-count:]
    return np.concatenate([np.full(count - len(last), np.nan), last])


def levels_of(states: Mapping[str, SweptStates]) -> MotionLevels:
    """Levels of the motions of a blade and scene, by motion."""
    first, rms = states[MOTIONS[0]], {motion: each.rms for motion, each in states.items()}
    return MotionLevels.averaged(first.speeds, rms, float(first.clearance), worn=first.worn)


OF_DWELLS = {
    "start": Variable((), "1", "where the dwell starts: in the high, the low or a random motion", "O"),
    "motion": Variable((), "1", "motion of the sweeps that it starts in, or number of the state", "O"),
    "speed": Variable((), "rad s-1", "angular speed of the rotor"),
    "level_high": Variable((), "m", "level of the largest motion of the sweeps there: mean rms of a revolution"),
    "level_low": Variable((), "m", "level of the smallest motion of the sweeps there"),
    "lined": Variable((), "1", "1 where a lining is worn, 0: the tip meets the casing itself", "i1"),
    **OF_KIND,
    "revolution_rms": Variable(
        ("revolution",), "m", "rms of the leading edge's motion, normal and tangential together, in each revolution", "f4"
    ),
}


def dwell_dataset(dwells: Sequence[tuple[Mapping[str, Any], Dwell]], revolutions: int) -> xr.Dataset:
    """Dataset of the dwells of one blade and scene: labels and levels of each, and what it found."""
    rows = [{**labels, **dwell.kind.values, "revolution_rms": dwell.rms} for labels, dwell in dwells]
    values: dict[str, Any] = {name: [row[name] for row in rows] for name in OF_DWELLS}
    values["revolution_rms"] = np.reshape(values["revolution_rms"], (-1, revolutions))
    values["revolution"] = np.arange(1, revolutions + 1)
    return dataset_of(OF_DWELLS, values, {"revolution": replace(AXES["revolution"], dtype="i8")}, {}, ("dwell",))
