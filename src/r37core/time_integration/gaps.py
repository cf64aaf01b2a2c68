"""The gap of every contact node at an instant."""

from __future__ import annotations

import numpy as np

from .problem import Problem


def gaps(
    problem: Problem, clearance: np.ndarray, displacement: np.ndarray, step: int, angle: float
) -> tuple[np.ndarray, np.ndarray]:
    """Distance (m) of every node from casing or lining, and the angle (rad) at which it meets it, shape (nodes,) both.

    `clearance` (m) of the round casing, shape (nodes,); `displacement` (m) of the nodes along its normal, tangent and meridian,
    shape (3, nodes), relative to a flexible casing; `step`: counted from the start of the run;
    `angle` (rad): at which the blade stands beyond that of its model.
    """
    theta = problem.casing.theta(step % problem.grid.steps_per_revolution) + angle
    normal, across, meridional = displacement
    position = normal
    if problem.scene.exact_gap:
        # the displaced node's radius is sqrt((r + u_r)^2 + u_theta^2), its angle theta + atan(u_theta/(r + u_r))
        cosine, sine = np.cos(problem.casing.cone_angle), np.sin(problem.casing.cone_angle)
        radius = problem.casing.tip.radius + cosine * normal + sine * meridional
        position = position + cosine * (np.hypot(radius, across) - radius)
        theta = theta + np.arctan2(across, radius)
    lobes = problem.scene.casing.lobe(theta, np.array(step * problem.grid.time_step), problem.grid.duration)
    return clearance - lobes - position, theta
