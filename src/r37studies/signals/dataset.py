"""signals.nc: signals of one blade and scene."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import SPEED, Variable, dataset_of
from r37core.rom.recovery_nodes import RecoveryNodes
from r37core.time_integration.simulate import TIP_POINTS
from r37core.time_integration.speed_arrays import STATUS
from r37studies.tip_timing import arrival_times

VARIABLES = {
    "normal": Variable(("tip_point", "turn"), "m", "displacement along the casing's normal", "f4"),
    "tangential": Variable(("tip_point", "turn"), "m", "tangential displacement, towards growing theta", "f4"),
    "strain": Variable(("gauge", "turn"), "1", "strain of the vibration along the gauge's grid", "f4"),
    "contact_force": Variable(("turn",), "N", "normal force on the tip, of all contact nodes; NaN without exact_modal", "f4"),
    "clearance": Variable(("turn",), "m", "from the undeformed leading edge to casing or unworn lining", "f4"),
    "casing_angle": Variable(("turn",), "degree", "of the undeformed leading edge, towards growing theta", "f4"),
    "gauge_place": Variable(("gauge", "axis"), "m", "where the gauge is, in the blade's frame"),
    "arrival_time": Variable(("tip_point", "probe", "revolution"), "s", "time at which the tip passes the probe"),
    "arrival_displacement": Variable(
        ("tip_point", "probe", "revolution"),
        "m",
        "tangential displacement that the arrival tells: radius times speed times its lateness",
    ),
    "status": STATUS["status"],
}
"""Dimensions are those beyond the run."""

AXES = {
    "turn": Variable(("turn",), "1", "time in revolutions since the start; times 2 pi / speed in s"),
    "revolution": Variable(("revolution",), "1", "number of the revolution", "i8"),
    "probe": Variable(("probe",), "degree", "angle of the probe round the casing"),
}


def signals_dataset(
    records: Mapping[float, Mapping[str, Any]],
    names: Mapping[float, str],
    gauges: Mapping[str, np.ndarray],
    probes: Sequence[float],
    tip: RecoveryNodes,
) -> xr.Dataset:
    """The records (record_signals) of one blade and scene by speed (rad/s), with arrivals at `probes` (degrees).

    `names`: interaction at a speed, where it is one; `gauges`: place (m) of each, shape (3,); `tip`: the tip line, from leading
    to trailing edge. All records have the same revolutions. What has no gauge or probe is left out; without records all but
    the speeds is.
    """
    speeds = list(records)
    if not speeds:
        return xr.Dataset(coords={"speed": ("speed", np.empty(0))})
    turn, (x, y, _) = records[speeds[0]]["turn"], tip.points[0]
    numbers = np.unique(np.ceil(turn)).astype(int)
    angle = np.degrees(np.arctan2(y, x) - 2.0 * np.pi * turn) % 360.0
    same = {"casing_angle": angle, "gauge_place": np.array(list(gauges.values())).reshape(-1, 3)}
    rows = []
    for speed, record in records.items():
        times, ends = turn * 2.0 * np.pi / speed, zip(record["tangential"], tip.points[[0, -1]], strict=True)
        told = np.array([arrival_times(times, *end, speed, np.radians(probes), numbers) for end in ends])
        rows.append({**same, **record, "arrival_time": told[:, 0], "arrival_displacement": told[:, 1]})
    values: dict[str, Any] = {name: [row[name] for row in rows] for name in VARIABLES}
    values |= {"speed": speeds, "turn": turn, "revolution": numbers, "probe": probes}
    labels = {"tip_point": list(TIP_POINTS), "gauge": np.array(list(gauges), dtype=object), "axis": ["x", "y", "z"]}
    dataset = dataset_of(VARIABLES, values, {"speed": SPEED, **AXES}, labels, ("speed",))
    dataset = dataset.assign_coords(interaction=("speed", [names.get(speed, "") for speed in speeds]))
    dataset = dataset.drop_dims([name for name, size in dataset.sizes.items() if size == 0])
    return dataset if gauges else dataset.drop_dims("axis")
