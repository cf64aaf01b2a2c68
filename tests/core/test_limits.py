"""Limits of the model: each alone puts a run beyond them, says so in words, and takes a verdict's *meets*."""

import numpy as np
import pytest
from quadratic_cases import LENGTH, SOFT_SIDEWAYS, beam_mesh, beam_model, free_blade

from r37core.fem.equilibrium import Rotation
from r37core.fem.large_displacement import LargeDisplacement
from r37core.fem.matrices import assemble
from r37core.fem.solver import factorise, lowest_modes
from r37core.results.limits import OF_LIMITS, beyond_limits, reasons_beyond_limits
from r37core.rom.quadratic_terms import PATH_SHARES
from r37core.rom.reduced_model import contact_model

WITHIN = {
    "peak_share_of_height": 0.1,
    "share_of_height_limit": 0.12,
    "largest_normal_force": 2000.0,
    "energy_residual_share": 0.02,
    "bounded_share_of_time": 0.0,
    "friction_power": 900.0,
    "friction_heat": 9000.0,
    "melting_power": 9000.0,
}

BEYOND = {
    "peak_share_of_height": (0.13, "moves by up to 0.13 of", "height 13%"),
    "largest_normal_force": (2100.0, "reach 2.1e+03 N", "force 2.1 kN"),
    "energy_residual_share": (0.021, "0.021 of the energy", "energy 2.1%"),
    "bounded_share_of_time": (1e-6, "friction.coefficient shows", "bound on the energy in 0.0001% of the steps"),
    "friction_power": (9100.0, "9.1e+03 W", "heat 9.1 kW"),
    "friction_heat": (9100.0, "9.1e+03 J", "heat 9.1 kJ"),
}


def runs_with(**changes):
    """Three runs, the last of them with the changes."""
    return {name: np.array([value, value, changes.get(name, value)]) for name, value in WITHIN.items()}


def test_each_limit_is_told_alone():
    assert set(OF_LIMITS) == set(WITHIN)
    assert not beyond_limits(runs_with()).any()
    assert reasons_beyond_limits(runs_with()) == {}
    for name, (value, text, brief) in BEYOND.items():
        runs = runs_with(**{name: value})
        assert beyond_limits(runs).tolist() == [False, False, True]
        ((said, reason),) = reasons_beyond_limits(runs).items()
        assert text in reason and said == brief


def test_linear_runs_have_no_limits_of_second_order():
    """Of a linear blade neither the motion nor its limit is known; heat is."""
    runs = runs_with(largest_normal_force=5e4, friction_power=1e5)
    linear = {name: values for name, values in runs.items() if "height" not in name}
    assert len(reasons_beyond_limits(linear)) == 1
    assert not beyond_limits({})
    assert reasons_beyond_limits({}) == {}


def held_by_full_finite_elements(share):
    """Amplitude of the lowest mode, radial and tangential displacement (m) of the tip, by Newton's method."""
    mesh = beam_mesh()
    matrices = assemble(mesh, SOFT_SIDEWAYS)
    solid = LargeDisplacement(mesh.blocks, mesh.points, SOFT_SIDEWAYS)
    rotation, mass, tip = Rotation(solid, matrices, follows=False), matrices.mass(), mesh.node_set("tip_pressure_edge")[0]
    (square,), mode = lowest_modes(matrices.stiffness(), mass, 1, matrices.solve_at_rest)
    load = square * (mass @ mode[:, 0]) * share * LENGTH / np.linalg.norm(rotation.whole(mode[:, 0])[tip])
    displacement = np.zeros_like(mesh.points)
    for part in np.repeat([0.25, 0.5, 0.75, 1.0], [5, 5, 5, 15]):
        residual = part * load - rotation.free(solid.forces(displacement))
        displacement = displacement + rotation.whole(factorise(rotation.tangent(displacement, 0.0))(residual))
    assert np.linalg.norm(load - rotation.free(solid.forces(displacement))) < 1e-6 * np.linalg.norm(load)
    x, y, _ = mesh.points[tip] / np.hypot(*mesh.points[tip, :2])
    u, v, _ = displacement[tip]
    return abs(mode[:, 0] @ (mass @ rotation.free(displacement))), u * x + v * y, v * x - u * y


@pytest.mark.parametrize("share", [0.1, 0.15, 0.2])
def test_error_of_the_path_is_that_against_full_finite_elements(share):
    """The reduced model at their amplitude; the scene's clearance says where that is too much."""
    model = beam_model()
    amplitude, radial, across = held_by_full_finite_elements(share)
    simulation, operator = free_blade(model, 1.0), contact_model(model, "pressure_edge").tip_displacement_operator
    problem, u = simulation.problem, np.zeros(len(simulation.problem.blade.frequencies))
    quadratic, own = problem.contact.quadratic, slice(1, len(u) - problem.blade.followers.shape[1])
    u[0] = amplitude * np.sign(operator[1, 0] @ problem.blade.modes[:, 0] * across)
    quadratic.follow(u, np.zeros_like(u))
    u[own] = (quadratic.force(u) / problem.blade.frequencies**2)[own]
    path = operator[0, 0] @ (problem.blade.modes @ u + problem.contact.product_shapes @ quadratic.products(u))
    error = np.interp(abs(across) / LENGTH, PATH_SHARES, model.quadratic.path_errors)
    assert error == pytest.approx(abs(path - radial), rel=0.1)
    assert model.quadratic.share_within(error) == pytest.approx(abs(across) / LENGTH, rel=1e-6)
    assert model.quadratic.share_within(1.0) == 0.2
