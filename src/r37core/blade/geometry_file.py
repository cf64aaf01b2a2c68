"""geometry.nc: the whole shape of one blade, and what was derived on the way to it."""

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path

import numpy as np
import xarray as xr

from r37core.base.dataset_file import about, read_dataset, write_dataset
from r37core.base.io import readable

from .blade_surface import Blade
from .profile import PRESSURE, SUCTION, Profile, ProfileParameters
from .stacking import Placement, conical_stacking

_COLUMNS = dict.fromkeys((field.name for field in fields(ProfileParameters)), "m")
_COLUMNS |= {"span": "1", "inlet_angle": "rad", "transition_angle": "rad", "outlet_angle": "rad"}
"""Units of the profiles' parameters."""
_STEPS = np.linspace(0.0, 1.0, 41)
"""Shares of chord and span at which the surfaces are sampled."""


def write_geometry(blade: Blade, file: Path | str, provenance: Mapping[str, object] | None = None) -> None:
    """Write the blade: table rows, placement, section properties, surface rates, volume, and both surfaces sampled."""
    data: dict = {
        name: ("profile", [getattr(p.parameters, name) for p in blade.profiles], about(units, name.replace("_", " ")))
        for name, units in _COLUMNS.items()
    }
    conical = conical_stacking(blade.profiles)
    chord, span = (a.ravel() for a in np.meshgrid(_STEPS, _STEPS, indexing="ij"))
    sides = [blade.position(chord, span, np.full_like(chord, side)) for side in (PRESSURE, SUCTION)]
    data |= {
        "axial_placement": ("profile", blade.placement.axial, about("m", "axial shift of the profile")),
        "rotation": ("profile", blade.placement.rotation, about("rad", "rotation of the profile about the axis")),
        "conical_axial_placement": ("profile", conical.axial, about("m", "axial shift by conical stacking alone")),
        "conical_rotation": ("profile", conical.rotation, about("rad", "rotation by conical stacking alone")),
        "section_area": ("profile", [p.area for p in blade.profiles], about("m2", "area on the unrolled cone")),
        "stagger": ("profile", [p.stagger for p in blade.profiles], about("rad", "stagger angle")),
        "surface_rate": (
            ("profile", "side", "segment"),
            [[[p.surfaces[s].front.rate, p.surfaces[s].rear.rate] for s in (PRESSURE, SUCTION)] for p in blade.profiles],
            about("rad m-1", "turning rate of the surface segment"),
        ),
        "volume": ((), blade.volume(), about("m3", "volume of the blade")),
        "surface": (
            ("side", "chord", "span_sample", "axis"),
            np.array(sides).reshape(2, len(_STEPS), len(_STEPS), 3),
            about("m", "points of the pressure and suction surfaces"),
        ),
    }
    coordinates = {
        "side": ["pressure", "suction"],
        "segment": ["inlet", "outlet"],
        "axis": ["x", "y", "z"],
        "chord": ("chord", _STEPS, about("1", "fraction of the surface's length from the leading edge")),
        "span_sample": ("span_sample", _STEPS, about("1", "fraction of the span from the hub")),
    }
    dataset = xr.Dataset(data, coordinates, attrs={"edges": "round" if blade.round_edges else "blunt"})
    write_dataset(dataset, file, provenance)


def read_geometry(file: Path | str) -> Blade:
    """The blade of a geometry.nc; InputFileError when the file cannot be read."""
    dataset = read_dataset(file)
    with readable(file):
        profiles = [
            Profile(ProfileParameters(**{name: float(dataset[name][i]) for name in _COLUMNS}))
            for i in range(dataset.sizes["profile"])
        ]
        placement = Placement(dataset["axial_placement"].values, dataset["rotation"].values)
        return Blade(profiles, placement, round_edges=dataset.attrs["edges"] == "round")
