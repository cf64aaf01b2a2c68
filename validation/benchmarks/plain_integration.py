"""Time integration as first written: dense matrices in NumPy, or scalar loops over modes in numba, for comparison.

Written from section 5 of the benchmark page, like the tests' NumPy twin; shares nothing with r37core's time integration but
parameters.
"""

import numpy as np
from numba import njit


class PlainProblem:
    """Constants of a run, taken from a Problem, in its modes and as dense matrices in the model's modes at rest."""

    def __init__(self, problem):
        model, scene = problem.model, problem.scene
        step, modes = problem.grid.time_step, problem.blade.modes
        damping = 2.0 * scene.damping_ratio * problem.blade.frequencies
        self.inverse = 1.0 / (1.0 / step**2 + damping / (2.0 * step))
        self.keep = self.inverse * (1.0 / step**2 - damping / (2.0 * step))
        self.pull = self.inverse * problem.blade.frequencies**2
        self.dense = [np.ascontiguousarray(modes @ np.diag(d) @ modes.T) for d in (self.keep, self.pull, self.inverse)]
        self.displacement_operator = problem.contact.displacement_operator
        self.coupling = np.array(
            [problem.contact.displacement_operator[0] * self.inverse @ rows.T for rows in problem.contact.displacement_operator]
        )
        steps = problem.grid.steps_per_revolution
        theta = model.theta - 2.0 * np.pi * np.arange(steps)[:, None] / steps
        self.shape = scene.casing.shape(theta)
        lining, friction = scene.lining, scene.friction
        bars = 0.0 if lining is None else float(lining.bars)
        self.bar_position = model.theta / (2.0 * np.pi) * bars
        area = 0.0 if lining is None else lining.area(float(np.max(model.radius)))
        law = (1.0, 1.0, 0.0, 0.0) if lining is None else lining_law(lining)
        self.numbers = np.array(
            [
                scene.casing.clearance,
                scene.casing.amplitude * scene.casing.clearance,
                scene.casing.rise_rate(problem.grid.duration) * step,
                *law,
                area,
                bars,
                friction.coefficient,
                # of the vibration's sliding velocities: constant friction leaves them out
                1.0 / step if friction.vector else 0.0,
            ]
        )
        self.rotation = -model.radius * problem.speed

    def modal(self, u, d, wear, first_step, steps):
        """The time integration in modes; changes its arguments."""
        modal(u, d, wear, first_step, steps, self.keep, self.pull, self.inverse, self.displacement_operator, *self._contact())

    def dense_recursion_numpy(self, u, d, steps):
        """The two dense products of every step alone, in NumPy: what contact costs is left out."""
        keep, pull, _ = self.dense
        for _ in range(steps):
            d = keep @ d - pull @ u
            u = u + d
        return u

    def _contact(self):
        return self.coupling, self.shape, self.bar_position, self.numbers, self.rotation


def lining_law(lining):
    return lining.thickness, lining.elastic_modulus, lining.plastic_modulus, lining.yield_stress


@njit
def contact_forces(gap, along, across, place, wear, coupling, bar_position, numbers, rotation, turn):
    """Forces (3, nodes) on the nodes from their predicted gaps and their velocities."""
    thickness, elastic, plastic, limit, area, bars, coefficient = numbers[3:10]
    nodes = len(gap)
    forces = np.zeros((3, nodes))
    directions = np.zeros((2, nodes))
    for k in range(nodes):
        slide = rotation[k] + along[k]
        size = np.sqrt(slide**2 + across[k] ** 2)
        directions[0, k], directions[1, k] = -slide / size, -across[k] / size
    left = gap.copy()
    if bars > 0.0:
        for k in range(nodes):
            if gap[k] < 0.0:
                bar = int(np.floor(bar_position[k] - turn * bars)) % int(bars)
                strain, worn = -gap[k] / thickness, wear[0, bar] / thickness
                if strain > worn:
                    over = elastic * (strain - worn) - limit - plastic * worn
                    if over > 0.0:
                        worn = min(worn + over / (elastic + plastic), 1.0)
                    wear[0, bar] = worn * thickness
                    forces[0, k] = -max(elastic * (strain - worn), 0.0) * area
                    forces[1, k] = -coefficient * forces[0, k] * directions[0, k]
                    forces[2, k] = -coefficient * forces[0, k] * directions[1, k]
        for k in range(nodes):
            left[k] += thickness
        for j in range(nodes):
            if forces[0, j] < 0.0:
                for k in range(nodes):
                    for axis in range(3):
                        left[k] -= coupling[axis, k, j] * forces[axis, j]
    closed = 0
    for k in range(nodes):
        closed += left[k] < 0.0
    if closed == 0:
        return forces
    touching = left < 0.0
    while np.any(touching):
        active = np.flatnonzero(touching)
        matrix = np.empty((nodes, len(active)))
        for j in range(len(active)):
            node = active[j]
            for k in range(nodes):
                along_push = coupling[1, k, node] * directions[0, node] + coupling[2, k, node] * directions[1, node]
                matrix[k, j] = coupling[0, k, node] - coefficient * along_push
        multipliers = np.linalg.solve(matrix[active], -left[active])
        opened = left + matrix @ multipliers
        following = opened < 0.0
        for j in range(len(active)):
            following[active[j]] = multipliers[j] > 0.0
        if np.all(following == touching):
            for j in range(len(active)):
                node = active[j]
                forces[0, node] -= multipliers[j]
                forces[1, node] += coefficient * multipliers[j] * directions[0, node]
                forces[2, node] += coefficient * multipliers[j] * directions[1, node]
            break
        touching = following
    return forces


@njit(fastmath=True)
def modal(u, d, wear, first, steps, keep, pull, inverse, rows, coupling, shape, bar_position, numbers, rotation):
    """Scalar loops over modes."""
    nodes, modes = rows.shape[1], rows.shape[2]
    per_revolution = len(shape)
    gap, along, across = np.empty(nodes), np.empty(nodes), np.empty(nodes)
    old, push = np.empty(modes), np.empty(modes)
    for n in range(first + 1, first + steps + 1):
        place = n % per_revolution
        lobes = numbers[1] * (1.0 - np.exp(-numbers[2] * n))
        for i in range(modes):
            old[i] = d[i]
            d[i] = keep[i] * d[i] - pull[i] * u[i]
            u[i] += d[i]
        touching = False
        for k in range(nodes):
            position = 0.0
            for i in range(modes):
                position += rows[0, k, i] * u[i]
            gap[k] = numbers[0] - lobes * shape[place, k] - position
            touching = touching or gap[k] < 0.0
        if touching:
            for k in range(nodes):
                total_along = total_across = 0.0
                for i in range(modes):
                    total_along += rows[1, k, i] * old[i]
                    total_across += rows[2, k, i] * old[i]
                along[k], across[k] = total_along * numbers[10], total_across * numbers[10]
            turn = place / per_revolution
            forces = contact_forces(gap, along, across, place, wear, coupling, bar_position, numbers, rotation, turn)
            push[:] = 0.0
            for k in range(nodes):
                if forces[0, k] < 0.0:
                    for i in range(modes):
                        push[i] += rows[0, k, i] * forces[0, k] + rows[1, k, i] * forces[1, k] + rows[2, k, i] * forces[2, k]
            for i in range(modes):
                d[i] += inverse[i] * push[i]
                u[i] += inverse[i] * push[i]
