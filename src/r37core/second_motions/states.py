"""States at the end of each speed of a sweep, in a file for the motions that go on from them."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from r37core.base.io import atomic_write, readable
from r37core.time_integration.carrying import END_WEAR, CarriedMotion, motion_names
from r37core.time_integration.speed_file import read_speed
from r37core.time_integration.status import RunStatus

from .choice import MOTIONS
from .ranges import MotionLevels


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
        return CarriedMotion.at_end({name: self._arrays[name][place] for name in ("status", *motion_names(self._arrays))})


def read_states(files: Sequence[Path | str]) -> dict[str, SweptStates]:
    """States of all motions of a blade and scene, in the order of MOTIONS, by motion."""
    return {motion: SweptStates(file) for motion, file in zip(MOTIONS, files, strict=True)}


def write_states(files: Sequence[Path], speeds: Sequence[float], clearance: float, file: Path | str) -> None:
    """Write the states of all speeds (rad/s, ascending) of a sweep, from the files of each, and the scene's `clearance` (m).

    Wear of carried linings is in single precision.
    """
    runs = [read_speed(each) for each in files]
    counted = [_counted(run) for run in runs]
    arrays = {name: np.array([run[name] for run in runs]) for name in ("status", *motion_names(runs[0]))}
    if END_WEAR in arrays:
        arrays[END_WEAR] = arrays[END_WEAR].astype(np.float32)
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
