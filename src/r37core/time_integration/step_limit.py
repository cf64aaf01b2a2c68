"""Time steps that a simulation bears: the limits of stability, each with the recursion it is derived from."""

import numpy as np
from numpy import ndarray

from r37core.base.io import CarriedError
from r37core.contact.scene import Scene

from .integrators import Recursion

WITH_FRICTION = 0.7
"""Largest ratio of pressed nodes with friction, which feeds motions near the limit: at 0.88 runs diverged, at 0.84 none did."""


class UnstableStepError(CarriedError):
    """A time step beyond a limit; `limit` (s), about what the problem bears, and `shortened` (s), what to take in its place.

    That is half of the limit unless it is given: just below a limit of stability a motion is bounded, but wrong.
    """

    def __init__(self, message: str, limit: float, shortened: float | None = None):
        super().__init__(message)
        self.limit, self.shortened = limit, 0.5 * limit if shortened is None else shortened


def largest_pressed_ratio(scene: Scene) -> float:
    """Largest ratio with which pressed nodes are stable in a scene."""
    return 1.0 if scene.friction is None else WITH_FRICTION


def ratio_of_pressed_nodes(recursion: Recursion, normal: ndarray, flexibility: ndarray) -> float:
    """Ratio of a step to its limit while all nodes are pressed on the casing, with the force of t_n; unstable from 1 on.

    `normal`: the nodes' normal displacement by stepped modes, shape (nodes, modes); `flexibility` (m/N): by static ones. The
    static modes hold a pressed node by a stiffness, R^-1 of all of them, and any lining in front of the casing is softer.
    The stepped modes follow u_{n+1} = (1 + k - M) u_n - k u_{n-1}, with k = keep and M = pull + C^(1/2) N^T R^-1 N C^(1/2),
    C = inverse, N the nodes' normal displacement and R the symmetric part of their residual flexibility. M is symmetric and
    positive, so for an eigenvector x both roots of lambda^2 - (1 + k_x - m_x) lambda + k_x lie inside the unit circle if
    m_x < 2 (1 + k_x), k_x and m_x being means over x.
    """
    pressed = normal * np.sqrt(recursion.inverse)
    matrix = np.diag(recursion.pull) + pressed.T @ np.linalg.solve(0.5 * (flexibility + flexibility.T), pressed)
    return float(np.linalg.eigvalsh(matrix)[-1]) / (2.0 * (1.0 + float(recursion.keep.min())))
