"""Campbell diagram of a blade on a disc: frequencies of its families of modes over nodal diameter and speed."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import scipy
from numpy import ndarray
from xarray import DataArray, Dataset

from r37core.base.dataset_file import SPEED
from r37core.base.variable import Variable
from r37core.fem.sector import aliased

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
