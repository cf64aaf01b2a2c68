"""Elastic stress from nodal displacements, by strains of first and of second order.

Strains follow from displacement gradients H_ij = du_i/dX_j, all of shape (..., 3, 3).
"""

from collections.abc import Callable

import numpy as np
from numpy import ndarray

from .assembly import Blocks, typed_blocks
from .elements import ELEMENTS
from .material import Material


def displacement_gradient(gradients: ndarray, displacement: ndarray) -> ndarray:
    """H at the points of some elements, shape (elements, points, 3, 3).

    `gradients` of the shape functions (1/m), shape (elements, points, n, 3); `displacement` of each element's nodes (m), shape
    (elements, n, 3).
    """
    return displacement.swapaxes(1, 2)[:, None] @ gradients


def linear_strain(gradient: ndarray) -> ndarray:
    """Strain of small displacements, (H + H^T)/2."""
    return 0.5 * (gradient + gradient.swapaxes(-1, -2))


def second_order_strain(first: ndarray, second: ndarray) -> ndarray:
    """(A^T B + B^T A)/2 of two gradients: half of it, with A = B, is what Green's strain has beyond the linear one."""
    return linear_strain(first.swapaxes(-1, -2) @ second)


def green_strain(gradient: ndarray) -> ndarray:
    """Strain of large displacements, (H + H^T + H^T H)/2."""
    return linear_strain(gradient) + 0.5 * gradient.swapaxes(-1, -2) @ gradient


COMPONENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
"""Order of the components of a stress: xx yy zz xy yz zx."""


def stress_at(gradients: ndarray, displacement: ndarray, material: Material) -> ndarray:
    """Stress tensors (Pa), shape (elements, points, 3, 3).

    `gradients`: shape-function gradients, shape (elements, points, n, 3); `displacement` of each element's nodes (m),
    shape (elements, n, 3).
    """
    return material.stress(linear_strain(displacement_gradient(gradients, displacement)))


def stress_numbers(blocks: Blocks, integration_points: bool) -> Blocks:
    """Number of each point of each element at which stress is evaluated, shape (elements, points of the type) by type.

    At nodes it is the node; the integration points of the stiffness are numbered through, types in alphabetical order.
    """
    if not integration_points:
        return blocks
    numbers, first = {}, 0
    for name in sorted(blocks):
        shape = len(blocks[name]), len(ELEMENTS[name].stiffness_rule[0])
        numbers[name] = first + np.arange(shape[0] * shape[1]).reshape(shape)
        first += numbers[name].size
    return numbers


def interpolated(blocks: Blocks, values: ndarray, integration_points: bool) -> ndarray:
    """Values of the nodes, shape (nodes, n), at the points that stress_numbers numbers, by the shape functions."""
    if not integration_points:
        return values
    numbers = stress_numbers(blocks, True)
    fields = np.empty((sum(part.size for part in numbers.values()), values.shape[1]))
    for name, element, nodal in typed_blocks(blocks, values):
        fields[numbers[name]] = element.shape_functions(element.stiffness_rule[0]) @ nodal
    return fields


def recovered_stress(
    blocks: Blocks, points: ndarray, displacement: ndarray, material: Material, integration_points: bool
) -> ndarray:
    """Linear stress (Pa), shape (6, numbers, fields), components as in COMPONENTS, by stress_numbers; 0 at nodes of no element.

    `displacement` (m), shape (nodes, 3, fields), of nodes at `points` (m). Each element's stress is evaluated at its own
    nodes, where bending stress is largest, and averaged over the elements that share the node; or at its integration points.
    """

    def stress(name: str, gradients: ndarray, field: int) -> ndarray:
        return stress_at(gradients, displacement[blocks[name], :, field], material)

    return _averaged(blocks, points, displacement.shape[2], stress, integration_points)


def second_order_stress(
    blocks: Blocks, points: ndarray, first: ndarray, second: ndarray, material: Material, integration_points: bool
) -> ndarray:
    """Stress by the strain of second order of two displacements, field by field, as recovered_stress has it."""

    def stress(name: str, gradients: ndarray, field: int) -> ndarray:
        pair = (displacement_gradient(gradients, each[blocks[name], :, field]) for each in (first, second))
        return material.stress(second_order_strain(*pair))

    return _averaged(blocks, points, first.shape[2], stress, integration_points)


def _averaged(
    blocks: Blocks, points: ndarray, fields: int, stress_of: Callable[[str, ndarray, int], ndarray], integration_points: bool
) -> ndarray:
    """Mean at each number of what its elements have there: tensors by the name of a type, its gradients and a field."""
    numbers = stress_numbers(blocks, integration_points)
    length = sum(part.size for part in numbers.values()) if integration_points else len(points)
    stress = np.zeros((len(COMPONENTS), length, fields))
    count = np.zeros(length)
    for name, element, coordinates in typed_blocks(blocks, points):
        members = numbers[name].ravel()
        count += np.bincount(members, minlength=length)
        local = element.stiffness_rule[0] if integration_points else element.nodes
        gradients, _ = element.physical_gradients(coordinates, local)
        for j in range(fields):
            field_stress = stress_of(name, gradients, j)
            for component, (a, b) in enumerate(COMPONENTS):
                weights = field_stress[:, :, a, b].ravel()
                stress[component, :, j] += np.bincount(members, weights=weights, minlength=length)
    return stress / np.maximum(count, 1.0)[:, None]
