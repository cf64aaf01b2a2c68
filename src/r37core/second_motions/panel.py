"""Panel of the explorer about second motions: the three motions over speed, with the ranges in which they differ."""

import xarray as xr

from r37core.explorer.contents import packed
from r37core.results.other_motions import half_step, swept

from .ranges import MotionLevels


def contents(motions: xr.Dataset) -> list[dict[str, object]]:
    """Each blade and scene of second_motions.nc: speeds (rad/s), mean rms (mm) of each motion, and ranges of speeds (rad/s)."""
    shown = []
    for blade in motions["blade"].values.tolist():
        for scene in motions["scene"].values.tolist():
            pair = swept(motions.sel(blade=blade, scene=scene))
            if not pair.sizes["speed"]:
                continue
            levels = MotionLevels.read(pair)
            half = half_step(levels.speeds)
            ends = [levels.speeds[part][[0, -1]] + (-half, half) for part in levels.ranges()]
            shown.append(
                {
                    "blade": blade,
                    "scene": scene,
                    "names": pair["motion"].values.tolist(),
                    "speeds": packed(levels.speeds, 64),
                    "mean": packed(1e3 * levels.mean),
                    "ranges": [[float(low), float(high)] for low, high in ends],
                }
            )
    return shown
