"""Contact along the normal of a conical casing."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, IntegrationChoice, Scene
from integration_cases import ABRADABLE, AT_ONCE, DIRECT, model_of_node
from integration_runs import ENGINES, whole_run
from reference_engine import ReferenceSimulation

from r37core.contact.casing import casing_axes
from r37core.results.campbell import campbell_diagram, dynamic_clearance
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.time_integration.initial_motion import InitialMotion

ANGLE = np.radians(-15.24)


def moving_along(directions, frequencies):
    """One node at the stacking line whose modes move it along the given (radial, tangential, axial) directions."""
    return model_of_node(np.transpose(directions), frequencies, tip_cone_angle=ANGLE)


NORMAL, MERIDIAN = (np.cos(ANGLE), 0.0, -np.sin(ANGLE)), (np.sin(ANGLE), 0.0, np.cos(ANGLE))
TANGENT = (0.0, 1.0, 0.0)


def test_axes_of_the_cone():
    """Of a casing that narrows downstream: the normal leans downstream, the meridian towards the axis."""
    np.testing.assert_allclose(casing_axes(np.array(NORMAL), ANGLE), [1.0, 0.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(casing_axes(np.array(MERIDIAN), ANGLE), [0.0, 0.0, 1.0], atol=1e-15)
    assert casing_axes(np.array([1.0, 0.0, 0.0]), ANGLE)[0] == pytest.approx(0.965, abs=1e-3)
    assert casing_axes(np.array([0.0, 0.0, 1.0]), ANGLE)[0] == pytest.approx(0.263, abs=1e-3)
    assert casing_axes(np.array([0.0, 0.0, 1.0]), ANGLE)[2] > 0.0


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("cone_angle", "touches"), [(None, False), (0.0, True)])
def test_a_node_sliding_along_the_cone_does_not_touch(engine, cone_angle, touches):
    """It swings by far more than the clearance along its meridian; a cylinder would be hit."""
    scene = Scene(Casing(1e-4, lobes=0, cone_angle=cone_angle), damping_ratio=0.0)
    simulation = ENGINES[engine](moving_along([MERIDIAN], [5e3]), 1000.0, scene, IntegrationChoice(1e-6, 1, 62))
    state = simulation.start()
    state.displacement[:] = 2e-3
    simulation.advance(state, 1)
    assert (state.totals["steps_in_contact"] > 0) == touches


@pytest.mark.parametrize("aside", [TANGENT, MERIDIAN], ids=["tangent", "meridian"])
def test_the_normal_force_does_no_work_along_the_casing(aside):
    """Without friction the mode along the casing swings on as if nothing touched, while the normal one bounces."""
    model, choice = moving_along([NORMAL, aside], [5e3, 6e3]), IntegrationChoice(1e-6, 2, 62)
    start = InitialMotion(np.array([-3e-4, -3e-4]), None)
    (_, state, record), (_, alone, _) = (
        whole_run(model, 1000.0, Scene(Casing(clearance, lobes=0), damping_ratio=0.0), choice, start)
        for clearance in (1e-4, 1.0)
    )
    assert state.totals["steps_in_contact"] > 0
    assert state.displacement[1] == pytest.approx(alone.displacement[1], rel=1e-9)
    assert abs(state.displacement[0] - alone.displacement[0]) > 1e-5
    assert record.samples[:, 0].max() <= 1e-4 * (1 + 1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("scene", [ABRADABLE, DIRECT], ids=["abradable", "direct"])
def test_cylinder_and_cone_are_the_same_round_an_untapered_tip(contact, scene):
    untapered, choice = replace(contact, tip_cone_angle=0.0), IntegrationChoice(2e-7, 1, 62)
    cone, cylinder = (
        whole_run(untapered, 1000.0, replace(scene, casing=replace(AT_ONCE, cone_angle=angle)), choice)[2].samples
        for angle in (None, 0.0)
    )
    np.testing.assert_array_equal(cone, cylinder)
    assert np.abs(cone).max() > 0.0
    assert np.abs(whole_run(contact, 1000.0, scene, choice)[2].samples - cone).max() > 1e-6


def test_exact_and_linear_gap_differ_by_the_square_of_the_motion(contact):
    """Motion and clearance are made smaller together."""
    speed, step = 1000.0, 1000
    differences = []
    for size in (1.0, 0.1, 0.01):
        gaps = []
        for exact in (False, True):
            scene = Scene(replace(AT_ONCE, clearance=size * 0.356e-3), exact_gap=exact)
            simulation = ReferenceSimulation(contact, speed, scene, IntegrationChoice(1e-7, 1, 62))
            shape = simulation.problem.blade.modes[:, 0] + 0.3 * simulation.problem.blade.modes[:, 1]
            shape *= size * 1e-3 / np.abs(contact.displacement_operator @ shape).max()
            gaps.append(simulation.engine.gap(shape, step)[0])
        differences.append(np.abs(gaps[1] - gaps[0]).max())
    np.testing.assert_allclose(np.array(differences[:-1]) / differences[1:], 100.0, rtol=0.1)


def test_exact_gap_is_the_distance_from_the_cone():
    """Points put into space and measured along the cone's normal, without the time integration's formulas."""
    radial, tangential, axial = 2e-3, 1.5e-2, 4e-3
    model = moving_along([(1, 0, 0), (0, 1, 0), (0, 0, 1)], [1e3, 2e3, 3e3])
    casing = Casing(1e-3, lobes=3, width=0.2, rise_fraction=0.0)
    simulation = ReferenceSimulation(model, 1000.0, Scene(casing, exact_gap=True), IntegrationChoice(1e-6, 1, 62))
    gap, theta = simulation.engine.gap(np.array([radial, tangential, axial]), simulation.problem.grid.steps_per_revolution)
    point = np.array([0.25 + radial, tangential, axial])
    radius, angle = np.hypot(point[0], point[1]), np.arctan2(point[1], point[0])
    # a line along the cone's ruling through the undeformed node, in the plane of radius and axis
    ruling, through = np.array([np.sin(ANGLE), np.cos(ANGLE)]), np.array([0.25, 0.0])
    offset = np.array([radius, point[2]]) - through
    distance = offset[0] * ruling[1] - offset[1] * ruling[0]
    assert theta[0] == pytest.approx(angle)
    assert gap[0] == pytest.approx(1e-3 * (1 - 2 * casing.shape(np.array([angle]))[0]) - distance, rel=1e-12)


@pytest.fixture(scope="module")
def forward_swept(settings, boundary, reduction):
    from r37core.fem.matrices import assemble
    from r37core.mesh.generate import generate_mesh

    blade = settings.blades["S100"]
    mesh = generate_mesh(blade.definition.build(round_edges=True), nodes=2500, layers=1, tip_elements=14)
    return reduce_blade(mesh, assemble(mesh, blade.material), blade.material, boundary, reduction, {})


def test_sweep_closes_the_normal_clearance_of_bending_and_opens_the_radial_one(model, forward_swept):
    """S100's 1B hardly moves towards a conical casing, against .215 of the reference blade's, though radially it moves more."""
    slopes = {}
    for name, one in (("Ref", model), ("S100", forward_swept)):
        shapes = campbell_diagram(one, np.linspace(0.0, 2000.0, 5), modes=3).shapes[:1, 0].T
        for casing, angle in (("cone", None), ("cylinder", 0.0)):
            change = dynamic_clearance(one, shapes, "pressure_edge", np.array([-1e-6, 1e-6]), angle)[0]
            slopes[name, casing] = (change[1] - change[0]) / 2e-6
    assert slopes["Ref", "cone"] == pytest.approx(0.215, rel=0.03)
    assert abs(slopes["S100", "cone"]) < 0.1 * abs(slopes["Ref", "cone"])
    assert abs(slopes["S100", "cylinder"]) > abs(slopes["Ref", "cylinder"])
    assert np.degrees(contact_model(forward_swept, "pressure_edge").tip_cone_angle) == pytest.approx(-15.24, abs=0.01)
