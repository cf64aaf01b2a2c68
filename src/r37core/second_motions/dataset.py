"""second_motions.nc, and the dwells of all blades and scenes joined."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from r37core.base.dataset_file import about, read_dataset
from r37core.results.regions import judged

from .choice import MOTIONS
from .motion_files import SweptStates, levels_of

KEPT = (
    *(f"{kind}_{direction}" for kind in ("rms", "peak") for direction in ("normal", "radial", "tangential")),
    *(f"max_von_mises_{name}" for name in ("ever", "median", "high")),
    "share_of_revolutions_above_yield",
    "max_wear",
    "used_thickness",
    "motion_kind",
    "lyapunov_exponent",
    "lyapunov_exponent_error",
    "recurrence",
    "recurrence_period",
    "status",
    "motion_at_end",
)
"""Variables of the responses that the dataset has, where they have them; it has the leading edge's motion alone."""

OF_ALL = ("yield_stress", "lined")
"""Variables that are the same at all speeds."""


def second_motions_dataset(
    responses: Mapping[tuple[str, str, str], Path | str],
    states: Mapping[tuple[str, str, str], Path | str],
    blades: Sequence[str],
    scenes: Sequence[str],
) -> xr.Dataset:
    """All sweeps, over (blade, scene, motion, speed), by the files of each blade, scene and motion.

    `motion_mean` and `motion_scatter` (m): of the rms of a revolution, normal and tangential together; `differ`, over (blade,
    scene, speed): whether the motions do. NaN for those of all `blades` and `scenes` that are not swept. Raises InputFileError.
    """
    pairs = list(dict.fromkeys((blade, scene) for blade, scene, _ in responses))
    parts = []
    for blade, scene in pairs:
        motions = []
        for motion in MOTIONS:
            response = judged(read_dataset(responses[blade, scene, motion], {"tip_point": "leading_edge"}))
            motions.append(response[[name for name in (*KEPT, *OF_ALL) if name in response]].reset_coords(drop=True))
        over_motions = [str(name) for name in motions[0].data_vars if name not in OF_ALL]
        part = xr.concat(motions, xr.Variable("motion", np.array(MOTIONS, dtype=object)), data_vars=over_motions)
        levels = levels_of({motion: SweptStates(states[blade, scene, motion]) for motion in MOTIONS})
        over = ("motion", "speed")
        mean = np.where(np.isinf(levels.mean), np.nan, levels.mean)
        part["motion_mean"] = over, mean, about("m", "mean rms of a revolution, normal and tangential together")
        part["motion_scatter"] = over, levels.scatter, about("m", "standard deviation of the rms of a revolution")
        compared = np.isin(np.arange(len(MOTIONS)), levels.compared).astype(float)
        part["compared"] = "motion", compared, about("1", "1 of motions that are compared, 0 of that on another lining")
        differ = about("1", "1 where two of the compared motions differ by more than they scatter")
        part["differ"] = ("speed",), levels.differ.astype(float), differ
        parts.append(part.expand_dims({"blade": [blade], "scene": [scene]}))
    joined = xr.combine_by_coords(parts, combine_attrs="drop_conflicts")
    assert isinstance(joined, xr.Dataset)
    return joined.reindex(blade=list(blades), scene=list(scenes))
