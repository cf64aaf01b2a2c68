"""Campbell diagram: frequencies over speed, modes followed and named by shape, crossings with engine orders; as a dataset.

Of a blade on a disc: frequencies of its families of modes over nodal diameter and speed.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pandas as pd
import scipy
import xarray as xr
from numpy import ndarray
from xarray import DataArray, Dataset

from r37core.base.dataset_file import SPEED, Variable, dataset_of, read_dataset
from r37core.contact.casing import approach
from r37core.fem.sector import aliased
from r37core.rom.rotation import BucklingError

if TYPE_CHECKING:
    # which imports scipy.linalg
    from r37core.rom.reduced_model import ReducedModel

DISC_VARIABLES = {
    "nodal_frequency": Variable(
        ("mode", "nodal_diameter", "speed"), "Hz", "frequency of the mode at each nodal diameter that is most like the blade's"
    ),
    "disc_frequency": Variable(("disc_mode", "nodal_diameter", "speed"), "Hz", "lowest frequencies of each nodal diameter"),
    "blade_likeness": Variable(("mode", "nodal_diameter"), "1", "MAC of that mode with the highest nodal diameter's, at rest"),
    "sectors": Variable((), "1", "number of sectors of the disc", "f8"),
}

DISC_AXES = {"nodal_diameter": Variable(("nodal_diameter",), "1", "nodal diameter of the disc", "i8"), "speed": SPEED}


class Families(NamedTuple):
    """Families of modes of a disc: `names`, frequencies (Hz) as in DISC_VARIABLES, and modes of the highest nodal diameter.

    `shapes`, shape (coordinates, modes): these in the reduced model's coordinates; `continuity`, shape (modes,): smallest MAC
    of the highest nodal diameter between neighbouring speeds.
    """

    names: tuple[str, ...]
    frequencies: ndarray
    every: ndarray
    likeness: ndarray
    shapes: ndarray
    continuity: ndarray


def named_order(model: ReducedModel, assurance: ndarray, count: int) -> tuple[tuple[str, ...], ndarray]:
    """Names and order of `count` modes by their MAC with the ideal shapes, shape (shapes, modes), of ascending frequency.

    The names of the shapes go to the modes with the largest sum of MAC; the others follow by frequency: 4, 5, ...
    """
    _, named = scipy.optimize.linear_sum_assignment(-assurance)
    others = np.setdiff1d(np.arange(assurance.shape[1]), named)
    names = (*model.shape_names, *map(str, range(len(named) + 1, count + 1)))
    return names[:count], np.array([*named, *others])[:count]


def disc_families(model: ReducedModel, speeds: ndarray, count: int, among: int) -> Families:
    """The `count` lowest families at ascending `speeds` (rad/s), named at the highest nodal diameter (the disc moves least).

    There 1B, 1T and 2B are the modes, of so many, that are most like the ideal shapes, and the others follow by frequency. At
    another nodal diameter the modes are assigned by the largest sum of their MAC; over speed each is followed.
    """
    disc = model.disc
    assert disc is not None
    real, imaginary = disc.shape_products
    products = np.abs(real + 1j * imaginary)[:, :among] ** 2 / model.shape_norms[:, None] ** 2
    names, order = named_order(model, products, count)
    diameters, modes = disc.squared_frequencies.shape
    reference = np.eye(modes)[:, order]
    frequencies, every = np.zeros((2, count, diameters, len(speeds)))
    likeness = np.zeros((count, diameters))
    for diameter in range(diameters):
        continuity, followed = np.ones(count), np.empty(0)
        for place, speed in enumerate(speeds):
            angular, shapes = disc.modes(diameter, speed)
            assurance = np.abs(shapes.conj().T @ followed) ** 2 if place else disc.assurance(diameter, shapes, reference)
            rows, columns = scipy.optimize.linear_sum_assignment(-assurance[: 2 * among])
            match = rows[np.argsort(columns)]
            values = assurance[match, np.arange(count)]
            if place:
                continuity = np.minimum(continuity, values)
            else:
                likeness[:, diameter] = values
            followed = shapes[:, match]
            frequencies[:, diameter, place], every[:, diameter, place] = angular[match], angular[:count]
    return Families(
        names, frequencies / (2.0 * np.pi), every / (2.0 * np.pi), likeness, disc.highest_modes @ reference, continuity
    )


def frequency_at_order(campbell: Dataset, mode: str, order: int | None) -> DataArray:
    """Frequency (Hz) over speed of a mode, on a disc at the nodal diameter that the engine order excites.

    Without an order, and of a blade without a disc, the one that all nodal diameters of a stiff disc share.
    """
    if order is None or "sectors" not in campbell or not np.isfinite(campbell["sectors"]):
        return campbell["frequency"].sel(mode=mode, drop=True)
    return campbell["nodal_frequency"].sel(mode=mode, nodal_diameter=aliased(order, int(campbell["sectors"])), drop=True)


_SPARE_MODES = 6
_NAMED_AMONG = 8


@dataclass(frozen=True)
class Campbell:
    """Campbell diagram of one blade.

    `speeds` (rad/s), shape (speeds,); `mode_names`, shape (modes,): 1B, 1T, 2B, then 4, 5, ... by frequency at rest;
    `frequencies` (Hz), shape (modes, speeds); `shapes`, shape (modes, speeds, coordinates), reduced, mass-normalised;
    `continuity`: smallest MAC between neighbouring speeds of each mode, shape (modes,).
    """

    speeds: ndarray
    mode_names: tuple[str, ...]
    frequencies: ndarray
    shapes: ndarray
    continuity: ndarray

    def crossing_speeds(self, engine_orders: ndarray) -> ndarray:
        """Speeds (rad/s), shape (modes, orders), of the crossings of each mode: see crossing_speed."""
        return np.array(
            [[crossing_speed(self.speeds, frequency, order) for order in engine_orders] for frequency in self.frequencies]
        )


def crossing_speed(speeds: ndarray, frequency: ndarray, order: int) -> float:
    """Speed (rad/s) where a frequency (Hz) at ascending `speeds` is an engine order of the speed.

    The first such speed within the diagram, NaN where there is none. The squared frequency, almost linear in the squared
    speed, is interpolated by a cubic spline.
    """
    squared_speeds = speeds**2
    spline = scipy.interpolate.CubicSpline(squared_speeds, (2.0 * np.pi * frequency) ** 2)
    above = spline(squared_speeds) - order**2 * squared_speeds
    change = np.flatnonzero((above[:-1] > 0.0) & (above[1:] <= 0.0))
    if not len(change):
        return np.nan
    bracket = squared_speeds[change[0]], squared_speeds[change[0] + 1]
    return float(np.sqrt(scipy.optimize.brentq(lambda s: float(spline(s)) - order**2 * s, *bracket, xtol=1e-9)))


def modal_assurance(first: ndarray, second: ndarray, mass: ndarray) -> ndarray:
    """Mass-weighted modal assurance criterion between two sets of shapes (columns), shape (first, second)."""
    product = (first.T @ mass @ second) ** 2
    norms = [np.einsum("ik,ij,jk->k", shapes, mass, shapes) for shapes in (first, second)]
    return product / norms[0][:, None] / norms[1]


def campbell_diagram(model: ReducedModel, speeds: ndarray, modes: int) -> Campbell:
    """Follow the `modes` lowest modes at the first speed over ascending `speeds` (rad/s)."""
    speeds = np.asarray(speeds, dtype=float)
    frequency, shape = model.modes(speeds[0], modes + _SPARE_MODES)
    names, order = name_modes(model, shape[:, : max(modes, _NAMED_AMONG)], modes)
    followed = shape[:, order]
    frequencies, shapes, continuity = [frequency[order]], [followed], []
    for speed in speeds[1:]:
        frequency, shape = model.modes(speed, modes + _SPARE_MODES)
        assurance = modal_assurance(followed, shape, model.mass)
        _, match = scipy.optimize.linear_sum_assignment(-assurance)
        continuity.append(assurance[np.arange(len(match)), match])
        followed = shape[:, match]
        frequencies.append(frequency[match])
        shapes.append(followed)
    return Campbell(
        speeds=speeds,
        mode_names=names,
        frequencies=np.array(frequencies).T / (2.0 * np.pi),
        shapes=np.array(shapes).transpose(2, 0, 1),
        continuity=np.min(continuity, axis=0) if continuity else np.ones(len(names)),
    )


def name_modes(model: ReducedModel, shapes: ndarray, count: int) -> tuple[tuple[str, ...], ndarray]:
    """Names and order of `count` modes among `shapes` (columns, ascending frequency): 1B, 1T, 2B, then 4, 5, ...

    The three names go to the modes with the largest MAC against the ideal shapes; the others follow by frequency.
    """
    norms = np.einsum("ik,ij,jk->k", shapes, model.mass, shapes)
    assurance = (model.shape_products @ shapes) ** 2 / model.shape_norms[:, None] ** 2 / norms
    return named_order(model, assurance, count)


def dynamic_clearance(model: ReducedModel, shapes: ndarray, tip_line: str, tangential_displacement: ndarray) -> ndarray:
    """Change of the leading-edge clearance (m), shape (modes, displacements), as the blade swings along free modes.

    `shapes`: reduced shapes (columns); `tangential_displacement` (m), positive towards growing theta, of the tip's
    leading edge on `tip_line`, round which the casing has the cone of the tip. The mode is scaled to that
    displacement; the node comes nearer to the casing by `approach`, and the clearance changes by the opposite.
    """
    line = model.tip_lines[tip_line]
    leading_edge = line.select([0])
    displacement = np.moveaxis(leading_edge.basis @ shapes, 2, 0)
    radial, tangential, axial = leading_edge.cylindrical(displacement)[:, 0].T[:, :, None]
    scale = tangential_displacement / tangential
    radius = np.hypot(*leading_edge.points[0, :2])
    swung = np.stack(np.broadcast_arrays(scale * radial, tangential_displacement, scale * axial))
    return -approach(radius, swung, line.cone_angle)


VARIABLES = {
    "frequency": Variable(("mode", "speed"), "Hz", "natural frequency"),
    "crossing_speed": Variable(
        ("mode", "engine_order"), "rad s-1", "speed at which the frequency is the engine order times the speed"
    ),
    "dynamic_clearance": Variable(
        ("mode", "tangential_displacement"),
        "m",
        "change of the leading-edge clearance, normal to the tip's cone, as the blade swings along the mode",
    ),
    "smallest_mac": Variable(("mode",), "1", "smallest MAC between neighbouring speeds"),
}

AXES = {
    "speed": SPEED,
    "engine_order": Variable(("engine_order",), "1", "engine order", "i8"),
    "tangential_displacement": Variable(
        ("tangential_displacement",), "m", "tangential displacement of the leading edge, positive against the rotation"
    ),
}


def campbell_dataset(
    model: ReducedModel,
    *,
    speeds: ndarray,
    modes: int,
    highest_engine_order: int,
    largest_tangential_displacement: float,
    tip_line: str,
) -> Dataset:
    """Frequencies at ascending `speeds` (rad/s) from 0, crossings with engine orders, dynamic clearance at rest.

    The displacement in m; `tip_line` carries the leading-edge node of the dynamic clearance.
    Raises ValueError for more modes than the model has coordinates, BucklingError where it has no stable position.
    """
    if modes > model.size:
        raise ValueError(f"campbell.modes in config.yaml: found {modes}; allowed: up to {model.size}, the reduced model's size")
    disc = (
        None if model.disc is None else disc_families(model, np.asarray(speeds, dtype=float), modes, max(modes, _NAMED_AMONG))
    )
    diagram = campbell_diagram(model, speeds, modes) if disc is None else _disc_diagram(disc, speeds)
    unstable = np.flatnonzero((diagram.frequencies <= 0.0).any(axis=0))
    if len(unstable):
        raise BucklingError(speeds[unstable[0]])
    orders = np.arange(1, highest_engine_order + 1)
    displacement = np.linspace(-1.0, 1.0, 41) * largest_tangential_displacement
    values = {
        "frequency": diagram.frequencies,
        "crossing_speed": diagram.crossing_speeds(orders) if disc is None else _crossings(model, disc, speeds, orders),
        "dynamic_clearance": dynamic_clearance(model, diagram.shapes[:, 0].T, tip_line, displacement),
        "smallest_mac": diagram.continuity,
        "speed": speeds,
        "engine_order": orders,
        "tangential_displacement": displacement,
    }
    dataset = dataset_of(VARIABLES, values, AXES, {"mode": list(diagram.mode_names)})
    if disc is not None and model.disc is not None:
        numbers: dict[str, Any] = {"nodal_frequency": disc.frequencies, "disc_frequency": disc.every}
        numbers["blade_likeness"] = disc.likeness
        numbers |= {"sectors": model.disc.sectors, "nodal_diameter": np.arange(disc.frequencies.shape[1]), "speed": speeds}
        dataset = dataset.assign(dataset_of(DISC_VARIABLES, numbers, DISC_AXES, {"mode": list(disc.names)}).data_vars)
    return dataset.assign_attrs(
        dynamic_clearance_tip_line=tip_line, tip_cone_angle_deg=float(np.degrees(model.tip_lines[tip_line].cone_angle))
    )


def _disc_diagram(disc: Families, speeds: ndarray) -> Campbell:
    """The diagram of the highest nodal diameter, where the disc moves least."""
    return Campbell(speeds, disc.names, disc.frequencies[:, -1], disc.shapes.T[:, None], disc.continuity)


def _crossings(model: ReducedModel, disc: Families, speeds: ndarray, orders: ndarray) -> ndarray:
    """Speeds (rad/s), shape (modes, orders), at which each mode of the nodal diameter that an order excites crosses it."""
    assert model.disc is not None
    excited = [aliased(int(order), int(model.disc.sectors)) for order in orders]
    return np.array(
        [
            [crossing_speed(speeds, family[number], order) for number, order in zip(excited, orders, strict=True)]
            for family in disc.frequencies
        ]
    )


def gather_blades(blades: Sequence[str], files: Iterable[Path | str]) -> Dataset:
    """One dataset with the dimension `blade` from one file per blade; the files' coordinates must agree.

    Nodal diameters are those of all discs; what a blade lacks is NaN.
    """
    datasets = [read_dataset(file).drop_attrs(deep=False) for file in files]
    most = max(datasets, key=lambda dataset: dataset.sizes.get("nodal_diameter", 0))
    if "sectors" in most:
        absent = xr.full_like(most[list(DISC_VARIABLES)], np.nan)
        numbers = most["nodal_diameter"]
        datasets = [
            data.reindex(nodal_diameter=numbers) if "sectors" in data else data.assign(absent.data_vars) for data in datasets
        ]
    return xr.concat(datasets, pd.Index(blades, name="blade"), join="exact", combine_attrs="override")
