"""Stress in a region from reduced coordinates. Light: the simulation jobs import it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy import ndarray

from r37core.base.io import atomic_write, readable
from r37core.rom.deviatoric import deviatoric
from r37core.rom.quadratic_terms import products_of
from r37core.rom.rotation import rotation_amplitudes


def von_mises(stress: ndarray) -> ndarray:
    """Von Mises stress (Pa), shape (...), of components xx yy zz xy yz zx, shape (6, ...)."""
    xx, yy, zz, xy, yz, zx = stress
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + zx**2))


@dataclass(frozen=True)
class StressOperator:
    """Stress at the evaluated nodes of a region: of the vibration, and of rotation where the coordinates have it.

    `operator`, shape (6, nodes, numbers + shapes): components xx yy zz xy yz zx (Pa) per unit of each number of the vibration,
    then of each amplitude of rotation's shapes. `coordinates`: how many reduced coordinates there are. `band`, shape (numbers,
    coordinates): amplitudes of the modes that count, per coordinate; None where the numbers are the coordinates. `region`: in
    words; `places`, shape (nodes, 3): chord, span and thickness of its nodes, where known.

    Of a blade about its equilibrium under rotation: `per_rotation`, shape (shapes, 6, nodes, coordinates): what an amplitude of
    rotation's shapes adds to the operator, see `displaced`, and their `rotation_stiffening`; `large_coordinates`, shape (modes,
    coordinates): amplitudes of the modes whose products, of second order, follow the coordinates among the numbers.
    """

    operator: ndarray
    coordinates: int
    region: str
    band: ndarray | None = None
    places: ndarray | None = None
    per_rotation: ndarray | None = None
    rotation_stiffening: ndarray | None = None
    large_coordinates: ndarray | None = None

    def displaced(self, speed: float) -> StressOperator:
        """The operator at a `speed` (rad/s): about the equilibrium there."""
        if self.per_rotation is None or self.rotation_stiffening is None:
            return self
        operator, amplitudes = self.operator.copy(), rotation_amplitudes(self.rotation_stiffening, speed)
        operator[:, :, : self.coordinates] += np.tensordot(amplitudes, self.per_rotation, axes=1)
        return replace(self, operator=operator, per_rotation=None)

    @cached_property
    def deviatoric(self) -> ndarray:
        """Parts per number whose length is the von Mises stress: shape (5, nodes, numbers + shapes), float32."""
        return deviatoric(self.operator)

    @cached_property
    def trace(self) -> ndarray:
        """Sum of the normal stresses (Pa) per number, shape (nodes, numbers + shapes)."""
        return self.operator[:3].sum(axis=0)

    def place(self, node: int) -> ndarray:
        """Chord, span and thickness of one of the nodes; NaN where they are not known."""
        return np.full(3, np.nan) if self.places is None else self.places[node]

    def have_rotation(self, coordinates: ndarray) -> bool:
        """True where the coordinates, shape (instants, coordinates), have the amplitudes of rotation's shapes."""
        return coordinates.shape[1] > self.coordinates

    def band_part(self, states: ndarray, shapes: ndarray) -> tuple[ndarray, ndarray]:
        """The part of `states`, shape (instants, numbers), in the modes that count, and their `shapes`.

        `shapes`, shape (coordinates, numbers): reduced coordinates per number; those given back are of the operator's numbers.
        """
        if self.large_coordinates is not None and len(self.large_coordinates):
            products = products_of(states @ (self.large_coordinates @ shapes).T)
            extended = np.zeros((len(shapes) + products.shape[1], shapes.shape[1] + products.shape[1]))
            extended[: len(shapes), : shapes.shape[1]] = shapes
            extended[len(shapes) :, shapes.shape[1] :] = np.eye(products.shape[1])
            return np.concatenate([states, products], axis=1), extended
        if self.band is None:
            return states, shapes
        return states @ (self.band @ shapes).T, np.eye(len(self.band))

    def max_von_mises(self, coordinates: ndarray) -> ndarray:
        """Largest von Mises stress (Pa) over the region, shape (instants,).

        `coordinates`, shape (instants, coordinates), of the vibration alone, or with the amplitudes of rotation's shapes after
        them: then it is the stress of both together.
        """
        return self.von_mises(coordinates).max(axis=1)

    def von_mises(self, coordinates: ndarray) -> ndarray:
        """Von Mises stress (Pa), shape (instants, nodes), for coordinates as above."""
        vibration, rotation = np.split(coordinates, [self.coordinates], axis=1)
        if self.band is not None:
            coordinates = np.concatenate([vibration @ self.band.T, rotation], axis=1)
        elif self.large_coordinates is not None:
            products = products_of(vibration @ self.large_coordinates.T)
            coordinates = np.concatenate([vibration, products, rotation], axis=1)
        operator = self.operator[:, :, : coordinates.shape[1]]
        return von_mises(np.einsum("cnj,tj->ctn", operator, coordinates, optimize=True))


StressOperators = Mapping[str, StressOperator]
"""Operators of a blade's regions by name; the first one decides."""


def operators_at(operators: StressOperators, speed: float) -> dict[str, StressOperator]:
    """The operators at a `speed` (rad/s)."""
    return {name: operator.displaced(speed) for name, operator in operators.items()}


def judged_operator(operators: StressOperators) -> StressOperator:
    """The operator of the region that decides."""
    return next(iter(operators.values()))


def write_stress_operators(operators: StressOperators, file: Path | str) -> None:
    """Write them as .npz."""
    arrays = {
        f"{name}.{field.name}": value
        for name, operator in operators.items()
        for field in fields(operator)
        if (value := getattr(operator, field.name)) is not None
    }
    with atomic_write(file) as partial:
        np.savez(partial, allow_pickle=False, **arrays)


def read_stress_operators(file: Path | str) -> dict[str, StressOperator]:
    """Read what `write_stress_operators` wrote. InputFileError when it cannot be read."""
    members: dict[str, dict[str, Any]] = {}
    with readable(file), np.load(file) as stored:
        for member in stored:
            name, field = member.rsplit(".", 1)
            value = stored[member]
            members.setdefault(name, {})[field] = value if value.ndim else value.item()
        return {name: StressOperator(**values) for name, values in members.items()}
