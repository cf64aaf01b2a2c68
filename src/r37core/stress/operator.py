"""Stress on the submesh from reduced coordinates. Light: the simulation jobs import it."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from r37core.base.io import atomic_write, readable


def von_mises(stress: np.ndarray) -> np.ndarray:
    """Von Mises stress (Pa), shape (...), of components xx yy zz xy yz zx, shape (6, ...)."""
    xx, yy, zz, xy, yz, zx = stress
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + zx**2))


@dataclass(frozen=True)
class StressOperator:
    """Stress at the nodes of the stress submesh: of the vibration, and of rotation where the coordinates have it.

    `operator`, shape (6, nodes, coordinates + shapes): components xx yy zz xy yz zx (Pa) per unit of each reduced coordinate,
    then of each amplitude of rotation's shapes. `coordinates`: how many of the former. `region`: the submesh in words.
    """

    operator: np.ndarray
    coordinates: int
    region: str

    @cached_property
    def deviatoric(self) -> np.ndarray:
        """Parts a to e per coordinate, whose length is the von Mises stress: shape (5, nodes, coordinates + shapes), float32.

        a = sqrt(3)/2 (xx - yy),  b = zz - (xx + yy)/2,  (c, d, e) = sqrt(3) (xy, yz, zx)
        """
        xx, yy, zz, xy, yz, zx = self.operator
        root = np.sqrt(3.0)
        parts = (0.5 * root * (xx - yy), zz - 0.5 * (xx + yy), root * xy, root * yz, root * zx)
        return np.stack(parts).astype(np.float32)

    @cached_property
    def trace(self) -> np.ndarray:
        """Sum of the normal stresses (Pa) per coordinate, shape (nodes, coordinates + shapes)."""
        return self.operator[:3].sum(axis=0)

    def have_rotation(self, coordinates: np.ndarray) -> bool:
        """True where the coordinates, shape (instants, coordinates), have the amplitudes of rotation's shapes."""
        return coordinates.shape[1] > self.coordinates

    def max_von_mises(self, coordinates: np.ndarray) -> np.ndarray:
        """Largest von Mises stress (Pa) over the submesh, shape (instants,).

        `coordinates`, shape (instants, coordinates), of the vibration alone, or with the amplitudes of rotation's shapes after
        them: then it is the stress of both together.
        """
        operator = self.operator[:, :, : coordinates.shape[1]]
        stress = np.einsum("cnj,tj->ctn", operator, coordinates, optimize=True)
        return von_mises(stress).max(axis=1)


def write_stress_operator(stress: StressOperator, file: Path | str) -> None:
    """Write it as .npz."""
    with atomic_write(file) as partial:
        np.savez(partial, operator=stress.operator, coordinates=stress.coordinates, region=stress.region)


def read_stress_operator(file: Path | str) -> StressOperator:
    """Read what `write_stress_operator` wrote. InputFileError when it cannot be read."""
    with readable(file), np.load(file) as stored:
        return StressOperator(stored["operator"], int(stored["coordinates"]), str(stored["region"]))
