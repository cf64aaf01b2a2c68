"""second_motions.nc."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.base.variable import about
from r37core.results.regions import judged
from r37core.time_integration.speed_arrays import OF_KIND

from .choice import MOTIONS
from .levels import read_levels

_JOINED = (
    *(f"{kind}_{direction}" for kind in ("rms", "peak") for direction in ("normal", "radial", "tangential")),
    *(f"max_von_mises_{name}" for name in ("ever", "median", "high")),
    "max_von_mises_inside",
    "exit_revolution",
    "share_of_revolutions_above_yield",
    "max_wear",
    "used_thickness",
    *OF_KIND,
    "status",
    "motion_at_end",
)
"""Variables of the responses that the dataset has, where they have them; it has the leading edge's motion alone."""

_OF_ALL = ("yield_stress", "lined")
"""Variables that are the same at all speeds."""


def pair_motions(responses: Sequence[Path | str], levels_files: Sequence[Path | str]) -> xr.Dataset:
    """The three sweeps of a blade and scene, over (motion, speed), by their responses and levels, in the order of MOTIONS.

    `motion_mean` and `motion_scatter` (m): of the rms of a revolution, normal and tangential together; `differ`, over speed: 1
    where the motions do; `revolutions`: of each motion. Raises InputFileError.
    """
    motions, lengths = [], []
    for file in responses:
        response = judged(read_dataset(file, {"tip_point": "leading_edge"}))
        lengths.append(int(response.attrs["revolutions"]))
        motions.append(response[[name for name in (*_JOINED, *_OF_ALL) if name in response]].reset_coords(drop=True))
    over_motions = [str(name) for name in motions[0].data_vars if name not in _OF_ALL]
    pair = xr.concat(motions, xr.Variable("motion", np.array(MOTIONS, dtype=object)), data_vars=over_motions)
    levels, over = read_levels(levels_files), ("motion", "speed")
    mean = np.where(np.isinf(levels.mean), np.nan, levels.mean)
    compared = np.isin(range(len(MOTIONS)), levels.compared).astype(float)
    differ = about("1", "1 where two of the compared motions differ by more than they scatter")
    return pair.assign(
        motion_mean=(over, mean, about("m", "mean rms of a revolution, normal and tangential together")),
        motion_scatter=(over, levels.scatter, about("m", "standard deviation of the rms of a revolution")),
        revolutions=("motion", lengths, about("1", "revolutions at each speed, at most where runs end as they have settled")),
        compared=("motion", compared, about("1", "1 of motions that are compared, 0 of that on another lining")),
        differ=("speed", levels.differ.astype(float), differ),
    )
