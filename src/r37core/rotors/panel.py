"""Panel of the explorer about whole rotors: every blade over speed, and growth and waves at each speed."""

import numpy as np
import xarray as xr

from r37core.explorer.contents import bin_starts, joined, packed, rounded

MOST_SPANS = 40
"""Spans of revolutions in a curve of growth; beyond it neighbours are joined by their maximum."""

NAMED = 3
"""Blades whose growth is shown, those of the largest motion; of all others the median is."""


def rotor_contents(rotors: xr.Dataset) -> list[dict[str, object]]:
    """Each rotor of `rotor.nc` (blade, scene) by ascending speed (rad/s), displacements in mm; NaN where a run diverged.

    Displacements are the motion of the leading edge, normal and tangential together.
    """
    names = list(dict.fromkeys(zip(rotors["blade"].values.tolist(), rotors["scene"].values.tolist(), strict=True)))
    return [_contents(rotors, blade, scene) for blade, scene in names]


def _contents(rotors: xr.Dataset, blade: str, scene: str) -> dict[str, object]:
    rotor = rotors.isel(run=((rotors["blade"] == blade) & (rotors["scene"] == scene)).values)
    # a rotor with more blades or longer runs may stand in the same dataset
    rotor = rotor.isel(blade_number=rotor["blade_angle"].notnull().any("run").values)
    for axis, name in (("span", "blade_maximum"), ("nodal_diameter", "nodal_diameter_share")):
        there = rotor[name].notnull().any([dim for dim in rotor[name].dims if dim != axis]).values
        rotor = rotor.isel({axis: there})
    rms = 1e3 * rotor["blade_rms"].transpose("run", "blade_number").values
    order = np.argsort(-np.nan_to_num(rms), axis=1, kind="stable")[:, :NAMED]
    starts = bin_starts(rotor.sizes["span"], MOST_SPANS)
    growth = joined(1e3 * rotor["blade_maximum"].transpose("run", "blade_number", "span").values, 2, starts)
    shown = np.concatenate([np.take_along_axis(growth, order[:, :, None], axis=1), np.median(growth, axis=1, keepdims=True)], 1)
    numbers = rotor["blade_number"].values
    return {
        "blade": blade,
        "scene": scene,
        "numbers": numbers.tolist(),
        "speeds": packed(rotor["speed"].values, 64),
        "rms": packed(rounded(rms)),
        "leader": packed(rotor["leader"].values),
        "above_yield": packed(len(numbers) * rotor["blades_above_yield"].values) if "blades_above_yield" in rotor else None,
        "spans": rotor["span"].values[np.append(starts[1:] - 1, -1)].tolist(),
        "largest": packed(numbers[order]),
        "growth": packed(rounded(shown)),
        "diameters": rotor["nodal_diameter"].values.tolist(),
        "shares": packed(rounded(100.0 * rotor["nodal_diameter_share"].transpose("run", "nodal_diameter").values)),
    }
