"""geometry.nc: the whole shape of one blade, and what was derived on the way to it."""

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path

import numpy as np
import xarray as xr

from r37core.base.dataset_file import about, read_dataset, write_dataset
from r37core.base.io import readable

from .blade_map import Blade, BladeMap, Meridian, SectionBlade
from .profile import PRESSURE, SUCTION, Profile, ProfileParameters
from .section_curve import SectionCurve
from .stacking import Placement, conical_stacking

_COLUMNS = dict.fromkeys((field.name for field in fields(ProfileParameters)), "m")
_COLUMNS |= {"span": "1", "inlet_angle": "rad", "transition_angle": "rad", "outlet_angle": "rad"}
"""Units of the profiles' parameters."""
_STEPS = np.linspace(0.0, 1.0, 41)
"""Shares of chord and span at which the surfaces are sampled."""


def write_geometry(blade: BladeMap, file: Path | str, provenance: Mapping[str, object] | None = None) -> None:
    """Write the blade: what gives its shape, section properties, volume, and both surfaces sampled."""
    if isinstance(blade, SectionBlade):
        data, coordinates = _sections(blade)
    else:
        assert isinstance(blade, Blade)
        data, coordinates = _profiles(blade)
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
    dataset = xr.Dataset(data, coordinates, attrs={"edges": "round" if blade.round_edges else "blunt"})
    write_dataset(dataset, file, provenance)


def _profiles(blade: Blade) -> tuple[dict, dict]:
    """Variables and coordinates of a blade given by profiles: table rows, placement, section properties, surface rates."""
    data: dict = {
        name: ("profile", [getattr(p.parameters, name) for p in blade.profiles], about(units, name.replace("_", " ")))
        for name, units in _COLUMNS.items()
    }
    conical = conical_stacking(blade.profiles)
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
    }
    return data, {"segment": ["inlet", "outlet"]}


def _sections(blade: SectionBlade) -> tuple[dict, dict]:
    """Variables and coordinates of a blade given by sections: their points one after the other, and what cuts them."""
    curves = blade.sections
    data: dict = {
        "section_point": (
            ("section_point_number", "axis"),
            np.concatenate([curve.file_points for curve in curves]),
            about("m", "points of the section curves"),
        ),
        "section_size": (
            "section",
            [len(curve.file_points) for curve in curves],
            about("1", "number of points of the section"),
        ),
        "place": ("section", blade.places, about("1", "fraction of the height at which the section lies")),
        "axial_placement": ("section", blade.placement.axial, about("m", "axial shift of the section")),
        "rotation": ("section", blade.placement.rotation, about("rad", "rotation of the section about the axis")),
        "stagger": ("section", [curve.stagger for curve in curves], about("rad", "stagger angle")),
        "pressure_forward": ((), int(blade.pressure_forward), about("1", "1 where the pressure side looks along the rotation")),
    }
    for name, surface in (("hub", blade.hub), ("tip", blade.tip)):
        if surface is not None:
            dims = (f"{name}_point", "meridian_axis")
            data[f"{name}_meridian"] = (dims, np.array(surface.points), about("m", f"axial place and radius of the {name}"))
    return data, {"meridian_axis": ["z", "r"]}


def read_geometry(file: Path | str) -> BladeMap:
    """The blade of a geometry.nc; InputFileError when the file cannot be read."""
    dataset = read_dataset(file)
    with readable(file):
        if "section_point" in dataset:
            return _section_blade(dataset)
        profiles = [
            Profile(ProfileParameters(**{name: float(dataset[name][i]) for name in _COLUMNS}))
            for i in range(dataset.sizes["profile"])
        ]
        placement = Placement(dataset["axial_placement"].values, dataset["rotation"].values)
        return Blade(profiles, placement, round_edges=dataset.attrs["edges"] == "round")


def _section_blade(dataset: xr.Dataset) -> SectionBlade:
    places, ends = dataset["place"].values, np.cumsum(dataset["section_size"].values)
    pressure_forward = bool(dataset["pressure_forward"])
    sections = [
        SectionCurve(points, f"section {number + 1} of {len(places)} from the hub", pressure_forward)
        for number, points in enumerate(np.split(dataset["section_point"].values, ends[:-1]))
    ]
    placement = Placement(dataset["axial_placement"].values, dataset["rotation"].values)
    hub, tip = (
        Meridian(dataset[f"{name}_meridian"].values) if f"{name}_meridian" in dataset else None for name in ("hub", "tip")
    )
    return SectionBlade(sections, places, placement, hub, tip, dataset.attrs["edges"] == "round", pressure_forward)
