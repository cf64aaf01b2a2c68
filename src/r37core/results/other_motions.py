"""Motions other than that from rest: an extension's dataset over (blade, scene, motion, speed), offered as `motions`.

`motion_mean` (m) is the mean rms of a revolution, normal and tangential together; `differ` is 1 where the motions differ. What
is not run is NaN.
"""

import numpy as np
from numpy import ndarray
from xarray import Dataset


def swept(motions: Dataset) -> Dataset:
    """Motions of one blade and scene at the speeds that they are run at."""
    return motions.isel(speed=np.flatnonzero(motions["differ"].notnull().values))


def half_step(speeds: ndarray) -> float:
    """Half of the smallest step between speeds: by so much a range of speeds is drawn beyond its ends; 0 of a single one."""
    return 0.5 * float(np.diff(speeds).min()) if len(speeds) > 1 else 0.0
