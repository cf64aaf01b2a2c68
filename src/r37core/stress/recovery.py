"""The stress operators of a reduced model."""

from collections.abc import Callable

import numpy as np
import scipy.linalg as la
from numpy import ndarray

from r37core.fem.material import Material
from r37core.fem.stress import recovered_stress, second_order_stress
from r37core.rom.quadratic_terms import mode_pairs
from r37core.rom.reduced_model import ReducedModel
from r37core.rom.rotation import rotation_amplitudes
from r37core.rom.stress_region import StressRegion

from .operator import StressOperator, judged_operator


def stress_operators(model: ReducedModel, material: Material) -> dict[str, StressOperator]:
    """Stress in the model's regions, by name: at integration points, or averaged over the region's elements that share a node.

    A region without elements is left out. Raises ValueError where the first one, which decides, has none, and where no mode is
    below a region's highest frequency.
    """
    first = next(iter(model.stress_regions))
    if not model.stress_regions[first].elements:
        raise ValueError(
            f"the stress region {first} ({model.stress_regions[first].description}) has no elements; enlarge it in "
            "structure.stress_regions in config.yaml (of an imported mesh, in its own stress_regions in blades.yaml), or use a "
            "finer mesh"
        )
    return {name: _operator(model, region, material) for name, region in model.stress_regions.items() if region.elements}


def stress_operator(model: ReducedModel, material: Material) -> StressOperator:
    """Stress in the region that decides. Raises what stress_operators raises."""
    return judged_operator(stress_operators(model, material))


def _operator(model: ReducedModel, region: StressRegion, material: Material) -> StressOperator:
    nodes, band = region.nodes, _band(model, region)
    basis = nodes.basis if band is None else nodes.basis @ band[1]
    evaluated, inside = region.evaluated, region.integration_points

    def stress(fields: ndarray) -> ndarray:
        return recovered_stress(region.elements, nodes.points, fields, material, inside)[:, evaluated]

    def second_order(first: ndarray, second: ndarray) -> ndarray:
        return second_order_stress(region.elements, nodes.points, first, second, material, inside)[:, evaluated]

    rotation = nodes.rotation_shapes
    large: dict[str, ndarray] = {}
    columns = [stress(basis), stress(rotation)]
    if model.logarithmic_stiffness is not None:
        columns[1] = _rotation_stress(model, model.logarithmic_stiffness.speeds, rotation, columns[1], second_order)
        # modes at rest below a frequency bend, and stretch nothing
        if band is None:
            products, large = _large_motion(model, basis, rotation, second_order)
            columns.insert(1, products)
    return StressOperator(
        operator=np.concatenate(columns, axis=2),
        coordinates=model.size,
        region=region.description,
        band=None if band is None else band[0],
        places=region.places,
        **large,
    )


SecondOrder = Callable[[ndarray, ndarray], ndarray]
"""Stress of second order of two sets of fields, shape (6, nodes, fields)."""


def _rotation_stress(
    model: ReducedModel, speeds: ndarray, shapes: ndarray, first_order: ndarray, second_order: SecondOrder
) -> ndarray:
    """Stress per amplitude of rotation's shapes, of which `first_order` is linear: together that of large displacements.

    It is exact at rest and at the two `speeds` (rad/s).
    """
    amplitudes = rotation_amplitudes(model.rotation_stiffening, speeds)
    displaced = shapes @ amplitudes.T
    stresses = first_order @ amplitudes.T + 0.5 * second_order(displaced, displaced)
    per_square = [first_order.sum(axis=2), *(stresses[..., place] / speed**2 for place, speed in enumerate(speeds))]
    squares = np.concatenate([[0.0], np.square(speeds)])
    shares = np.linalg.inv(1.0 / (1.0 + np.outer(squares, model.rotation_stiffening)))
    return np.tensordot(np.stack(per_square, axis=-1), shares, axes=([-1], [1]))


def _large_motion(
    model: ReducedModel, basis: ndarray, rotation: ndarray, second_order: SecondOrder
) -> tuple[ndarray, dict[str, ndarray]]:
    """Columns of a stress operator for the products of second order of large displacements, and fields of StressOperator."""
    per_rotation = np.stack(
        [second_order(np.broadcast_to(shape[..., None], basis.shape), basis) for shape in np.moveaxis(rotation, 2, 0)]
    )
    coordinates = np.empty((0, model.size)) if model.quadratic is None else model.quadratic.coordinates
    first, second = mode_pairs(len(coordinates))
    fields = basis @ la.solve(model.mass, coordinates.T)
    weights = np.where(first == second, 0.5, 1.0)
    large = {"per_rotation": per_rotation, "rotation_stiffening": model.rotation_stiffening, "large_coordinates": coordinates}
    return weights * second_order(fields[..., first], fields[..., second]), large


def _band(model: ReducedModel, region: StressRegion) -> tuple[ndarray, ndarray] | None:
    """Amplitudes per coordinate, shape (modes, coordinates), of the modes at rest that count, and their shapes; None: all."""
    if not np.isfinite(region.highest_frequency):
        return None
    frequencies, modes = model.modes(0.0)
    shapes = modes[:, frequencies <= 2.0 * np.pi * region.highest_frequency]
    if not shapes.size:
        raise ValueError(
            f"stress_regions: found highest_frequency_hz {region.highest_frequency:g} ({region.description}); "
            f"allowed: more than the first mode's, {frequencies[0] / 2.0 / np.pi:.6g} Hz at rest"
        )
    return shapes.T @ model.mass, shapes
