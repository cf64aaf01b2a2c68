"""Blades of large displacements that tests share, and what a constant load does to them."""

from dataclasses import replace

import numpy as np
from box_mesh import box_mesh
from defaults import BoundaryChoice, Casing, IntegrationChoice, Scene

from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import ReductionChoice
from r37core.rom.region_choice import RegionChoice
from r37core.time_integration.integrators import EXACT_MODAL
from r37core.time_integration.simulate import Simulation

LENGTH, THICKNESS, WIDTH = 0.2, 0.002, 0.01
SOFT_SIDEWAYS = Material(200e9, 8000.0, 0.0)
"""Without contraction a thin beam is one of Euler and Bernoulli."""

FAR = Scene(Casing(1.0, lobes=0), damping_ratio=0.0)
"""A casing that nothing reaches."""

CHOICE = IntegrationChoice(6.4e-6, 200, 62, integrator=EXACT_MODAL)


def beam_mesh(along_axis=False, start=0.0):
    """Mesh of the beam of beam_model."""
    width, height = (WIDTH, THICKNESS) if along_axis else (THICKNESS, WIDTH)
    return box_mesh(LENGTH, width, height, (16, 1, 1), origin=(start, -width / 2, -height / 2), element="hexahedron20")


def beam_model(along_axis=False, start=0.0, maximum=20.0, kinematics="quadratic", modes=1):
    """Reduced model of a thin beam that stands out from the axis, bending along theta or, if asked for, along the axis."""
    mesh = beam_mesh(along_axis, start)
    regions = {"all": RegionChoice(minimum_span=0.05)}
    speeds = (0.0, 0.5 * maximum, maximum)
    reduction = ReductionChoice(speeds, 10, kinematics=kinematics, quadratic_modes=modes)
    return reduce_blade(mesh, assemble(mesh, SOFT_SIDEWAYS), SOFT_SIDEWAYS, BoundaryChoice(nodes=2), reduction, regions)


def free_blade(model, speed, **changes):
    """Simulation of a blade without contact and damping."""
    choice = replace(CHOICE, **changes)
    return Simulation(contact_model(model, "pressure_edge"), speed, FAR, choice)


def held(simulation, force):
    """Displacement of the stepped modes under constant modal forces, and of the modes at rest: by Newton's method."""
    contact, frequencies = simulation.problem.contact, simulation.problem.blade.frequencies
    quadratic, followers, u = contact.quadratic, simulation.problem.blade.followers.shape[1], force / frequencies**2
    free = slice(len(u) - followers)
    for _ in range(200):
        quadratic.follow(u, np.zeros_like(u))
        tangent = np.array([quadratic.force(u + step) - quadratic.force(u - step) for step in 1e-9 * np.eye(len(u))]) / -2e-9
        correction = np.linalg.solve(np.diag(frequencies**2) + tangent, force + quadratic.force(u) - frequencies**2 * u)
        u = u + correction
        if np.linalg.norm(correction[free]) <= 1e-9 * np.linalg.norm(u[free]):
            break
    return u, simulation.problem.blade.modes @ u + contact.product_shapes @ quadratic.products(u)
