"""Strains of first and second order from displacement gradients H_ij = du_i/dX_j, all of shape (..., 3, 3)."""

from numpy import ndarray


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
