"""Time steps that a simulation bears: the limits of stability, each with the recursion it is derived from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from r37core.contact.scene import Scene

from .integrators import CENTRAL_DIFFERENCE, Recursion

if TYPE_CHECKING:
    from .problem import Problem

WITH_FRICTION = 0.7
"""Largest ratio of pressed nodes with friction, which feeds motions near the limit: at 0.88 runs diverged, at 0.84 none did."""

_OF_BLADE = "this reduced model", "raise basis_tolerance to drop the highest modes"


class UnstableStepError(ValueError):
    """A time step beyond a limit; `limit` (s), about what the problem bears, and `shortened` (s), what to take in its place.

    That is half of the limit unless it is given: just below a limit of stability a motion is bounded, but wrong.
    """

    def __init__(self, message: str, limit: float, shortened: float | None = None):
        super().__init__(message)
        self.limit, self.shortened = limit, 0.5 * limit if shortened is None else shortened


def check_step(problem: Problem) -> None:
    """Raises UnstableStepError unless the problem's step is below its limits, of the free blade and of the pressed one."""
    choice, step = problem.choice, problem.time_step
    taken = f"time_step_s: {choice.time_step:g} s gives steps of {step:.6g} s, not below the"
    if choice.integrator == CENTRAL_DIFFERENCE:
        _check_published_step(problem, taken)
        return
    ratio = pressed_ratio(problem) / largest_pressed_ratio(problem.scene)
    if not ratio < 1.0:
        limit = step / np.sqrt(ratio)
        raise UnstableStepError(
            f"{taken} limit for nodes pressed on the casing, about {limit:.6g} s; use a smaller one", float(limit)
        )


def _check_published_step(problem: Problem, taken: str) -> None:
    highest = problem.highest_frequency
    limit = 2.0 / highest
    of_casing = highest > problem.frequencies[-1]
    what, remedy = ("this casing", "leave its highest modes out") if of_casing else _OF_BLADE
    if not problem.time_step < limit:
        raise UnstableStepError(
            f"{taken} stability limit of {what}, {limit:.6g} s (highest mode {highest / 2e3 / np.pi:.1f} kHz); "
            f"use a smaller one, {remedy}, or take the integrator exact_modal",
            limit,
        )
    if problem.scene.lining is None:
        return
    ratio = predicted_ratio(problem)
    if not ratio < 1.0:
        limit = problem.time_step / np.sqrt(ratio)
        raise UnstableStepError(
            f"{taken} limit for this lining, about {limit:.6g} s (bars of {problem.bar_stiffness:.4g} N/m); use a smaller one, "
            "or a softer, thicker or narrower lining",
            limit,
        )


def predicted_ratio(problem: Problem) -> float:
    """How near the limit a lining is, whose force is that of the prediction; unstable from 1 on.

    A node pressed by x on an elastic bar follows x_{n+1} = (1 - g)(2 x_n - x_{n-1}), g = bar stiffness times c at the node;
    both roots of the recursion lie inside the unit circle for 0 < g < 4/3.
    """
    return problem.bar_stiffness * float(np.linalg.eigvalsh(problem.coupling[0])[-1]) * 0.75


def largest_pressed_ratio(scene: Scene) -> float:
    """Up to which pressed nodes are stable in a scene."""
    return 1.0 if scene.friction is None else WITH_FRICTION


def pressed_ratio(problem: Problem) -> float:
    """How near the limit a step of the problem is in which all nodes are pressed on the casing: see ratio_of_pressed_nodes.

    A coupled mode counts as two, with the real and the imaginary part of its shape: the limit is where a motion changes its
    sign in every step, and there the two are not coupled.
    """
    of, normal, flexibility = problem.recursion, problem.displacement_operator[0], problem.contact_flexibility[0]
    if problem.complex_operator is not None:
        normal = np.hstack([problem.complex_operator[0].real, problem.complex_operator[0].imag])
        of = Recursion(*(np.tile(part, 2) for part in (of.keep, of.pull, of.inverse, of.lost)))
    return ratio_of_pressed_nodes(of, normal, flexibility)


def ratio_of_pressed_nodes(recursion: Recursion, normal: np.ndarray, flexibility: np.ndarray) -> float:
    """How near the limit a step is in which all nodes are pressed on the casing, with the force of t_n; unstable from 1 on.

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
