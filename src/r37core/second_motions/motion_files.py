"""Files of the sweeps, dwells and branches of one blade and scene."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import Variable, about
from r37core.base.io import atomic_write, readable
from r37core.results.variables import OF_KIND
from r37core.time_integration.carrying import CarriedMotion
from r37core.time_integration.speed_file import read_speed
from r37core.time_integration.status import RunStatus

from .branches import Bifurcation
from .choice import MOTIONS
from .dwelling import Dwell
from .periodic import Orbit
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
    "speed": Variable((), "rad s-1", "angular speed of the rotor"),
    "level_high": Variable((), "m", "level of the largest motion of the sweeps there: mean rms of a revolution"),
    "level_low": Variable((), "m", "level of the smallest motion of the sweeps there"),
    "lined": Variable((), "1", "1 where a lining is worn, 0: the tip meets the casing itself", "i1"),
    **OF_KIND,
    "revolution_rms": Variable(
        ("revolution",), "m", "rms of the leading edge's motion, normal and tangential together, in each revolution", "f4"
    ),
}


def dwell_dataset(rows: Sequence[tuple[Mapping[str, Any], Dwell]], revolutions: int) -> xr.Dataset:
    """Dataset of the dwells of one blade and scene: labels and levels of each, and what it found."""
    columns: dict[str, list[Any]] = {name: [] for name in ("start", "motion", *OF_DWELLS)}
    for labels, dwell in rows:
        values = {**labels, **dwell.kind.values, "revolution_rms": dwell.rms}
        for name, column in columns.items():
            column.append(values[name])
    labels = {name: np.array(columns.pop(name), dtype=object) for name in ("start", "motion")}
    shapes = {name: (len(rows), revolutions) if OF_DWELLS[name].dims else (len(rows),) for name in columns}
    dataset = xr.Dataset(
        {
            name: (
                ("dwell", *variable.dims),
                np.array(columns[name], variable.dtype).reshape(shapes[name]),
                variable.attributes,
            )
            for name, variable in OF_DWELLS.items()
        }
        | {
            "start": ("dwell", labels["start"], about("1", "where the dwell starts: in the high, the low or a random motion")),
            "motion": ("dwell", labels["motion"], about("1", "motion of the sweeps that it starts in, or number of the state")),
        },
        {"revolution": ("revolution", np.arange(1, revolutions + 1), about("1", "number of the revolution"))},
    )
    return dataset


def orbit_dataset(branches: Sequence[tuple[Sequence[Orbit], Sequence[Bifurcation]]], revolution: int) -> xr.Dataset:
    """Dataset of the orbits of branches, one after another along each, with `revolution` samples in a revolution."""
    rows = [
        (number, orbit, next((event for event in events if event.orbit == place), None))
        for number, (orbits, events) in enumerate(branches, 1)
        for place, orbit in enumerate(orbits)
    ]

    def column(values: list[Any], units: str, long_name: str, dtype: Any = float) -> tuple[str, np.ndarray, dict[str, str]]:
        return "orbit", np.array(values, dtype), about(units, long_name)

    orbits = [orbit for _, orbit, _ in rows]
    first = [orbit.multipliers[0] for orbit in orbits]
    events = [event for _, _, event in rows]
    return xr.Dataset(
        {
            "branch": column([number for number, _, _ in rows], "1", "number of the branch", "i4"),
            "speed": column([orbit.speed for orbit in orbits], "rad s-1", "angular speed of the rotor"),
            "rms_normal": column([orbit.rms[0] for orbit in orbits], "m", "rms of the leading edge's normal displacement"),
            "rms_tangential": column([orbit.rms[1] for orbit in orbits], "m", "rms of its tangential displacement"),
            "peak_normal": column([orbit.peak for orbit in orbits], "m", "largest normal displacement"),
            "period": column([orbit.samples / revolution for orbit in orbits], "1", "period in revolutions"),
            "multiplier_real": column([value.real for value in first], "1", "largest Floquet multiplier, real part"),
            "multiplier_imaginary": column([value.imag for value in first], "1", "largest Floquet multiplier, imaginary part"),
            "event": column(
                [event.event.value if event else "" for event in events], "1", "what happens just before the orbit", object
            ),
            "event_speed": column(
                [event.speed if event else np.nan for event in events], "rad s-1", "speed at which it happens"
            ),
        }
    )
