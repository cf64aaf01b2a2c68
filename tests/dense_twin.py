"""A plain NumPy twin of the march: the recursion with dense matrices, in the coordinates of the modes at rest.

Written from section 5 of the benchmark, sharing nothing with the kernel but the parameters.
"""

import numpy as np
import scipy.linalg as la

from r37core.contact.casing import casing_axes


def dense_march(contact, scene, speed, step, steps_per_revolution, steps, duration, start):
    """March `steps` steps from rest at `start`; returns the final coordinates and the wear (rings, bars)."""
    stiffness = np.diag(contact.squared_frequencies) + speed**2 * contact.stiffness_per_square
    mass = np.eye(len(stiffness))
    squares, modes = la.eigh(stiffness)
    damping = modes @ np.diag(2 * scene.damping_ratio * np.sqrt(squares)) @ modes.T
    inverse = np.linalg.inv(mass / step**2 + damping / (2 * step))
    # A + B = 1 - C K: the same recursion as u_{n+1} = A u_n + B u_{n-1} + C F, whose A alone rounds away 1e-9 of omega^2
    b = inverse @ (damping / (2 * step) - mass / step**2)
    pull = inverse @ stiffness
    radial, tangential, axial = casing_axes(contact.rows, scene.casing.angle(contact.tip_cone_angle))
    nodes = radial.shape[0]
    now, increment = start, np.zeros(len(start))
    lining, friction = scene.lining, scene.friction
    wear = np.zeros((1 if lining and lining.shared_ring else nodes, lining.bars)) if lining else None
    area = lining.area(contact.radius.max()) if lining else None
    for n in range(1, steps + 1):
        predicted = -b @ increment - pull @ now
        after = now + predicted
        theta = contact.theta - 2 * np.pi * (n % steps_per_revolution) / steps_per_revolution
        distance = scene.casing.distance(theta, n * step, duration)
        position = radial @ after
        if scene.exact_gap:
            position = np.hypot(contact.radius + position, tangential @ after) - contact.radius
        gap = distance - position
        force = np.zeros(len(start))
        directions = np.zeros((nodes, len(start)))
        if friction:
            rotation = contact.radius * speed * (-1 if friction.against_rotation else 1)
            velocity_t, velocity_z = tangential @ increment / step, axial @ increment / step
            if not friction.vector:
                velocity_t, velocity_z = 0 * velocity_t, 0 * velocity_z
            sliding = np.stack([rotation + velocity_t, velocity_z], axis=1)
            unit = sliding / np.linalg.norm(sliding, axis=1, keepdims=True)
            directions = -friction.coefficient * (unit[:, :1] * tangential + unit[:, 1:] * axial)
        if lining:
            for k in np.flatnonzero(gap < 0):
                ring = 0 if lining.shared_ring else k
                bar = int(np.floor(theta[k] / (2 * np.pi) * lining.bars)) % lining.bars
                strain, plastic = -gap[k] / lining.thickness, wear[ring, bar] / lining.thickness
                if strain > plastic:
                    over = lining.elastic_modulus * (strain - plastic) - lining.yield_stress - lining.plastic_modulus * plastic
                    if over > 0:
                        plastic = min(plastic + over / (lining.elastic_modulus + lining.plastic_modulus), 1.0)
                    wear[ring, bar] = plastic * lining.thickness
                    pressure = max(lining.elastic_modulus * (strain - plastic), 0.0) * area
                    force += pressure * (-radial[k] + directions[k])
            gap = gap + lining.thickness - radial @ (inverse @ force)
        touching = np.flatnonzero(gap < 0)
        while len(touching):
            pushes = -radial[touching] + (directions[touching] if friction and friction.coupled else 0.0)
            matrix = -radial[touching] @ inverse @ pushes.T
            multipliers = np.linalg.solve(matrix, -gap[touching])
            trial = force + multipliers @ (-radial[touching] + (directions[touching] if friction else 0.0))
            left = gap - radial @ (inverse @ (multipliers @ pushes))
            if np.all(multipliers >= 0) and np.all(np.delete(left, touching) >= 0):
                force = trial
                break
            closed = (left < 0) & ~np.isin(np.arange(nodes), touching)
            touching = np.flatnonzero(closed | np.isin(np.arange(nodes), touching[multipliers > 0]))
        increment = predicted + inverse @ force
        now = now + increment
    return now, wear
