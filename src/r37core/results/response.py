"""response.nc: all speeds of one blade and scene."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy import ndarray

from r37core.base.dataset_file import dataset_of, write_dataset
from r37core.stress.statistic import UNKNOWN, Strengths, goodman_statistic, stress_statistic
from r37core.time_integration.simulate import TIP_POINTS
from r37core.time_integration.speed_file import read_speed, sizes_of

from .events import exit_of, goodman_events, yield_events
from .variables import AXES, COUNTED, HISTORIES, OF_ALL_SPEEDS, VARIABLES


def write_response(
    files: Iterable[Path | str],
    speeds: Sequence[float],
    file: Path | str,
    *,
    stress_history_speeds: Sequence[float],
    yield_stress: float,
    strengths: Strengths = UNKNOWN,
    provenance: Mapping[str, object],
) -> Path | str:
    """Reduce the files of the `speeds` (rad/s, ascending), in the same order, to one `file`; this is returned.

    Speeds in `stress_history_speeds`, which have recorded it, keep the largest stress of every revolution. `yield_stress` (Pa)
    and `strengths`: of the blade's material. Raises InputFileError for a file that cannot be read.
    """
    rows, histories, last = list[dict[str, ndarray]](), {}, dict[str, ndarray]()
    for speed, speed_file in zip(speeds, files, strict=True):
        last = run_row(read_speed(speed_file), yield_stress, strengths)
        rows.append({name: np.asarray(last[name], entry.dtype) for name, entry in VARIABLES.items() if name in last})
        if speed in stress_history_speeds:
            histories[speed] = last["revolution_von_mises"]
    values: dict[str, Any] = last | {name: np.stack([row[name] for row in rows]) for name in rows[0]} | {"speed": speeds}
    if histories:
        values |= {"history_speed": [*histories], "max_von_mises_history": np.stack([*histories.values()])}
    labels = {"tip_point": list(TIP_POINTS)} | ({"region": values["region"]} if "region" in values else {})
    response = dataset_of(VARIABLES, values, AXES, labels, ("speed",))
    write_dataset(response.merge(dataset_of(OF_ALL_SPEEDS | HISTORIES, values, {}, {})), file, provenance)
    return file


def run_row(run: Mapping[str, ndarray], yield_stress: float, strengths: Strengths) -> dict[str, ndarray]:
    """The variables of one speed, and the coordinates that they need."""
    sizes = sizes_of(run)
    values = {**run, **exit_of(run)}
    left = float(values["exit_revolution"])
    values |= {name: np.arange(1, sizes[name] + 1) for name in COUNTED if name in sizes}
    if "wear" in run:
        values["angle"] = np.arange(sizes["angle"]) * 2.0 * np.pi / sizes["angle"]
        values["lobes"] = np.arange(sizes["lobes"])
    if "max_von_mises_last_revolution" in run:
        values["yield_stress"] = np.array(yield_stress)
    if "revolution_von_mises" in run:
        history = run["revolution_von_mises"]
        values |= stress_statistic(in_statistic(run, history), yield_stress)
        values["max_von_mises_ever"] = np.where(run["status"], np.nan, np.fmax.reduce(history, axis=1))
        values |= yield_events(run, yield_stress, left)
    if "alternating_stress" in run:
        values |= goodman_statistic(run, strengths)
        if strengths.are_known:
            values |= goodman_events(run, strengths, left)
    return values


def in_statistic(run: Mapping[str, ndarray], history: ndarray) -> ndarray:
    """A history of a run, shape (rows, revolutions), over the revolutions in the statistic alone."""
    revolutions, end = len(run["revolution_maximum"]), int(run["statistic_end"])
    # a history of all revolutions has them in place, a shorter one is that of the last
    last = history[:, :end] if history.shape[1] == revolutions else history
    return last[:, -int(run["statistic_revolutions"]) :]
