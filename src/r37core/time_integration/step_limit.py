"""Time steps that a simulation bears: the limits of stability, each with the recursion it is derived from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from r37core.contact.laws import series_modulus
from r37core.contact.scene import Lining

from .integrators import CENTRAL_DIFFERENCE

if TYPE_CHECKING:
    from .problem import Problem

_LARGEST_LAG = 0.03
"""Of what nodes' forces add to each other's static displacement, relative to what they cause by themselves."""


_OF_BLADE = "this reduced model", "raise basis_tolerance to drop the highest modes"


class UnstableStepError(ValueError):
    """A time step beyond a stability limit; `limit` (s), about what the problem bears."""

    def __init__(self, message: str, limit: float):
        super().__init__(message)
        self.limit = limit


def check_step(problem: Problem) -> None:
    """Raises UnstableStepError unless the problem's step is below its limits, of the free blade and of the lining."""
    choice, step, highest = problem.choice, problem.time_step, problem.highest_frequency
    given = f"time_step_s: {choice.time_step:g} s gives steps of {step:.6g} s, not below the"
    limit = 2.0 / highest
    of_casing = highest > problem.frequencies[-1]
    what, remedy = ("this casing", "leave its highest modes out") if of_casing else _OF_BLADE
    if choice.integrator == CENTRAL_DIFFERENCE and not step < limit:
        raise UnstableStepError(
            f"{given} stability limit of {what}, {limit:.6g} s (highest mode {highest / 2e3 / np.pi:.1f} kHz); "
            f"use a smaller one, {remedy}, or take the integrator exact_modal",
            limit,
        )
    lining = problem.scene.lining
    if lining is None:
        return
    ratio = second_order_ratio(problem, lining) if problem.second_order else predicted_ratio(problem)
    if not ratio < 1.0:
        limit = step / np.sqrt(ratio)
        raise UnstableStepError(
            f"{given} limit for this lining, about {limit:.6g} s (bars of {problem.bar_stiffness:.4g} N/m); use a smaller one, "
            "or a softer, thicker or narrower lining",
            limit,
        )


def predicted_ratio(problem: Problem) -> float:
    """How near the limit a lining is, whose force is that of the prediction; unstable from 1 on.

    A node pressed by x on an elastic bar follows x_{n+1} = (1 - g)(2 x_n - x_{n-1}), g = bar stiffness times c at the node;
    both roots of the recursion lie inside the unit circle for 0 < g < 4/3.
    """
    return problem.bar_stiffness * float(np.linalg.eigvalsh(problem.coupling[0])[-1]) * 0.75


def second_order_ratio(problem: Problem, lining: Lining) -> float:
    """How near the limit a lining is, whose force is that of t_n; unstable from 1 on.

    With all nodes on elastic bars the stepped modes follow u_{n+1} = (1 + k - M) u_n - k u_{n-1}, with k = keep and
    M = pull + C^(1/2) N^T K N C^(1/2), C = inverse, N the nodes' normal displacement and K the bars in series with each node's
    own residual flexibility. M is symmetric and positive, so for an eigenvector x both roots of
    lambda^2 - (1 + k_x - m_x) lambda + k_x lie inside the unit circle if m_x < 2 (1 + k_x), k_x and m_x being means over x.
    The static displacement that the other nodes' forces add lags by a step. F_n = -K (N u_n + R F_{n-1}), R the residual
    flexibility without its diagonal, and about F = -A (N u - h R A N du/dt), A = (K^-1 + R)^-1: the lag damps some motions and
    feeds others, because R has no trace. The structure's damping bears that while the largest singular value of
    K^(1/2) R K^(1/2) is below _LARGEST_LAG, found with every few of the nodes pressed, on several blades and linings.
    A coupled mode counts as two, with the real and the imaginary part of its shape: the limit is where a motion changes its
    sign in every step, and there the two are not coupled.
    """
    recursion, normal, flexibility = problem.recursion, problem.displacement_operator[0], problem.residual_flexibility[0]
    inverse, pull = recursion.inverse, recursion.pull
    if problem.complex_operator is not None:
        normal = np.hstack([problem.complex_operator[0].real, problem.complex_operator[0].imag])
        inverse, pull = np.tile(inverse, 2), np.tile(pull, 2)
    own = np.diag(flexibility)
    series = series_modulus(lining.elastic_modulus, problem.bar_stiffness, own) * (problem.bar_area / lining.thickness)
    root = np.sqrt(inverse)
    matrix = np.diag(pull) + (root[:, None] * normal.T * series) @ (normal * root)
    stepped = float(np.linalg.eigvalsh(matrix)[-1]) / (2.0 * (1.0 + float(recursion.keep.min())))
    half = np.sqrt(series)
    lagging = half[:, None] * (flexibility - np.diag(own)) * half
    return max(stepped, float(np.linalg.norm(lagging, 2)) / _LARGEST_LAG)
