"""geometry.nc: the whole shape of one blade, and what was derived on the way to it."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from xarray import Dataset

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import function_named, readable
from r37core.base.packages import registered
from r37core.base.variable import about

from .blade_map import Blade, BladeMap
from .profile import PARAMETER_UNITS, PRESSURE, SUCTION, Profile, ProfileParameters
from .stacking import Placement

_STEPS = np.linspace(0.0, 1.0, 41)
"""Shares of chord and span at which the surfaces are sampled."""


def write_geometry(blade: BladeMap, file: Path | str, provenance: Mapping[str, object] | None = None) -> None:
    """Write the blade: what gives its shape, section properties, volume, and both surfaces sampled."""
    data, coordinates = blade.described()
    chord, span = (a.ravel() for a in np.meshgrid(_STEPS, _STEPS, indexing="ij"))
    sides = [blade.position(chord, span, np.full_like(chord, side)) for side in (PRESSURE, SUCTION)]
    data |= {
        "volume": ((), blade.volume(), about("m3", "volume of the blade")),
        "surface": (
            ("side", "chord", "span_sample", "axis"),
            np.array(sides).reshape(2, len(_STEPS), len(_STEPS), 3),
            about("m", "points of the pressure and suction surfaces"),
        ),
    }
    coordinates |= {
        "side": ["pressure", "suction"],
        "axis": ["x", "y", "z"],
        "chord": ("chord", _STEPS, about("1", "fraction of the surface's length from the leading edge")),
        "span_sample": ("span_sample", _STEPS, about("1", "fraction of the span from the hub")),
    }
    dataset = Dataset(data, coordinates, attrs={"edges": "round" if blade.round_edges else "blunt"})
    write_dataset(dataset, file, provenance)


def read_geometry(file: Path | str) -> BladeMap:
    """The blade of a geometry.nc; InputFileError when the file cannot be read."""
    dataset = read_dataset(file)
    with readable(file):
        for variable, reader in registered("GEOMETRIES").items():
            if variable in dataset:
                return function_named(reader)(dataset)
        profiles = [
            Profile(ProfileParameters(**{name: float(dataset[name][i]) for name in PARAMETER_UNITS}))
            for i in range(dataset.sizes["profile"])
        ]
        placement = Placement(dataset["axial_placement"].values, dataset["rotation"].values)
        return Blade(profiles, placement, round_edges=dataset.attrs["edges"] == "round")
