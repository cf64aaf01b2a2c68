"""Casing, lining, friction and the complementarity solve against hand or brute-force answers; contact along a cone's normal."""

import itertools
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from contact_laws import friction_direction, press_nodes, return_mapping
from defaults import Casing, IntegrationChoice, Lining, Scene
from hypothesis import given, settings
from hypothesis import strategies as st
from integration_cases import AT_ONCE, model_of_node
from integration_runs import ENGINES, whole_run
from motion_at_start import MotionAtStart
from reference_engine import ReferenceSimulation
from scipy.optimize import brentq

from r37core.contact import laws
from r37core.contact.casing import casing_axes
from r37core.contact.laws import wear_at_the_casing

BAR = Lining(5e-3, 20e9, 5e9, 1e6, bar_width=1e-3)


def test_casing_of_the_benchmark():
    """Its lobes grow in a fifth of 200 revolutions, 40, which a run of 1,000 needs to be told."""
    casing = Casing(0.356e-3)
    assert casing.shape(np.array([np.pi / 2, 3 * np.pi / 2])) == pytest.approx([1.0, 1.0])
    assert casing.shape(np.array([0.0])) == pytest.approx(np.exp(-((0.5 / 0.15) ** 2)))
    assert casing.lobe(np.array([1.0]), 0.0, casing.rise_time(1.0, 200)) == 0.0
    late = casing.lobe(np.array([np.pi / 2]), 0.2, casing.rise_time(1.0, 200))
    assert late == pytest.approx(0.356e-3 * 2.0 * 0.99)
    second_per_revolution = 4e-3
    for revolutions, casing in ((200, Casing(1e-3)), (1000, Casing(1e-3, rise_revolutions=40.0))):
        assert casing.rise_time(revolutions * second_per_revolution, revolutions) == pytest.approx(40 * second_per_revolution)
    assert Casing(1e-3).rise_time(4.0, 1000) == pytest.approx(0.8)


def test_circular_casing_and_casing_deformed_from_the_start():
    theta = np.linspace(0.0, 6.0, 50)
    np.testing.assert_array_equal(Casing(1e-3, lobes=0).lobe(theta, 5.0, 10.0), 0.0)
    at_once = Casing(1e-3, rise_fraction=0.0)
    np.testing.assert_allclose(at_once.lobe(theta, 0.0, at_once.rise_time(10.0, 200)), 2e-3 * at_once.shape(theta))


def test_pressed_areas_are_of_the_tip_or_as_published_of_a_bar():
    """Only the published one depends on the number of bars, and not on the length of tip that a node stands for."""
    lining, lengths = Lining(5e-3, 20e9, 5e9, 1.5, contact_length=2e-4), np.array([1e-3, 4e-3])
    for bars in (2500, 40_000):
        np.testing.assert_allclose(replace(lining, bars=bars).pressed_areas(lengths, 0.25), [2e-7, 8e-7])
    published = Lining(5e-3, 20e9, 5e9, 1.5, bar_width=1e-3)
    np.testing.assert_allclose(published.pressed_areas(lengths, 0.2523), 1.585e-7, rtol=1e-3)
    np.testing.assert_array_equal(replace(published, bar_area=3e-6).pressed_areas(lengths, 0.2523), 3e-6)
    # with a published lining every node has one
    nowhere = np.array([1e-3, 0.0])
    assert published.pressed_areas(nowhere, 0.25).all()
    with pytest.raises(ValueError, match="stands for no length of tip"):
        lining.pressed_areas(nowhere, 0.25)


def test_bar_pushed_released_and_pushed_again():
    """By hand: E = 20, K = 5 GPa, 1 MPa to yield, 5 mm thick."""
    stress, wear = return_mapping(2e-7, 0.0, BAR)  # strain 4e-5: 0.8 MPa, elastic
    assert (stress, wear) == (pytest.approx(0.8e6), 0.0)
    stress, wear = return_mapping(1e-6, wear, BAR)  # trial 4 MPa; plastic strain (4 - 1)e6/25e9 = 1.2e-4
    assert wear == pytest.approx(1.2e-4 * 5e-3)
    assert stress == pytest.approx(4e6 - 20e9 * 1.2e-4)  # 1.6 MPa = 1 MPa + 5 GPa * 1.2e-4
    worn = wear
    assert return_mapping(5e-7, worn, BAR) == (0.0, worn)  # released: the bar is shorter by its wear
    stress, wear = return_mapping(8e-7, worn, BAR)  # reloaded elastically below the hardened yield
    assert (stress, wear) == (pytest.approx(20e9 * (8e-7 - worn) / 5e-3), worn)
    stress, wear = return_mapping(2e-6, worn, BAR)  # same as if pushed there at once
    at_once = return_mapping(2e-6, 0.0, BAR)
    assert (stress, wear) == (pytest.approx(at_once[0]), pytest.approx(at_once[1]))


@given(
    st.lists(st.floats(-1e-3, 8e-3), min_size=1, max_size=30), st.floats(1e6, 1e12), st.floats(0.0, 1e12), st.floats(0.0, 1e9)
)
def test_wear_never_shrinks_and_a_bar_never_pulls(pushes, elastic, plastic, yield_stress):
    wear, bar = 0.0, Lining(5e-3, elastic, plastic, yield_stress, bar_width=1e-3)
    for push in pushes:
        stress, new = return_mapping(push, wear, bar)
        plain_stress, plain_wear = laws.return_mapping(push, wear, bar.elastic_modulus, bar)
        assert stress == pytest.approx(plain_stress, rel=1e-12, abs=1e-14 * elastic)  # a difference of stresses near E
        assert new == pytest.approx(plain_wear, rel=1e-12)
        assert stress >= 0.0
        assert wear <= new <= 5e-3
        wear = new


@pytest.mark.parametrize("plastic", [0.0, 5e9])
def test_a_bar_at_the_casing_is_worn_as_far_as_it_can_be(plastic):
    """By less than its thickness where it hardens: its elastic part springs back."""
    lining = replace(BAR, plastic_modulus=plastic)
    stress, worn = return_mapping(lining.thickness, 0.0, lining)
    assert wear_at_the_casing(lining) == pytest.approx(worn, rel=1e-12) and worn <= lining.thickness
    assert worn + lining.thickness * stress / lining.elastic_modulus == pytest.approx(lining.thickness, rel=1e-12)


def test_friction_opposes_sliding():
    assert friction_direction(-250.0, 0.0) == (1.0, 0.0)
    assert friction_direction(250.0, 0.0) == (-1.0, 0.0)
    tangential, meridional = friction_direction(-200.0, 100.0)
    assert (tangential, meridional) == (pytest.approx(200 / np.hypot(200, 100)), pytest.approx(-100 / np.hypot(200, 100)))
    assert friction_direction(0.0, 0.0) == (0.0, 0.0)


def brute_force(matrix, gap):
    """Try every set of touching nodes."""
    n = len(gap)
    for touching in itertools.chain.from_iterable(itertools.combinations(range(n), k) for k in range(n + 1)):
        multipliers = np.zeros(n)
        index = list(touching)
        if index:
            multipliers[index] = np.linalg.solve(matrix[np.ix_(index, index)], -gap[index])
        opened = gap + matrix @ multipliers
        if np.all(multipliers >= -1e-12) and np.all(opened >= -1e-12 * np.abs(gap).max()):
            return multipliers
    raise AssertionError


@settings(max_examples=200)
@given(st.integers(0, 2**31 - 1), st.integers(1, 6), st.floats(0.0, 0.3))
def test_complementarity_against_brute_force(seed, n, skew):
    generator = np.random.default_rng(seed)
    factor = generator.standard_normal((n, n + 2))
    matrix = factor @ factor.T
    part = generator.standard_normal((n, n))
    matrix = matrix + skew * np.diag(matrix).min() * (part - part.T) / n  # friction makes it unsymmetric, still a P-matrix
    gap = generator.standard_normal(n)
    expected = brute_force(matrix, gap)
    # whatever forces it begins with
    for start in (0.0, generator.random(n)):
        multipliers, change = press_nodes(matrix, gap, start=start)
        assert change == 0.0 and np.all(multipliers >= 0.0)
        np.testing.assert_allclose(multipliers, expected, rtol=1e-7, atol=1e-9)


def opening_of_nodes(generator, n, friction=0.2):
    """How static modes open the gaps of n nodes per normal force on each, with its friction: nearly diagonal columns."""
    size = generator.uniform(0.5, 2.0, n)
    factor = generator.standard_normal((n, 3 * n + 3)) / np.sqrt(3 * n + 3)
    along = factor + 0.2 * generator.standard_normal(factor.shape) / np.sqrt(3 * n + 3)
    normal, tangential = (np.eye(n) + 0.3 / n**0.5 * (rows @ factor.T - np.eye(n)) for rows in (factor, along))
    # friction of each node along its own sliding, so that a column is one node's
    matrix = normal + friction * (tangential - np.eye(n)) * generator.uniform(-1.0, 1.0, n)
    return matrix * np.sqrt(np.outer(size, size)) * 1e-8


@settings(max_examples=200)
@given(st.integers(0, 2**31 - 1), st.integers(1, 6))
def test_forces_of_nodes_at_the_casing_against_brute_force(seed, n):
    generator = np.random.default_rng(seed)
    matrix, gap = opening_of_nodes(generator, n), 1e-5 * generator.standard_normal(n)
    expected, largest = brute_force(matrix, gap), np.abs(gap).max()
    # from rest, from anything, from the answer; by the sweeps, too, which are done where pieces go on changing
    for start, by_sweeps in product((0.0, generator.uniform(0.0, 1e3, n), expected), (False, True)):
        forces, change = press_nodes(matrix, gap, start=start, by_sweeps=by_sweeps)
        assert change == 0.0
        np.testing.assert_allclose(np.diag(matrix) * forces, np.diag(matrix) * expected, rtol=0, atol=1e-10 * largest)


def test_forces_of_more_nodes_than_a_vector_holds():
    generator = np.random.default_rng(5)
    for _ in range(20):
        matrix, gap = opening_of_nodes(generator, 19), 1e-5 * generator.standard_normal(19)
        forces, change = press_nodes(matrix, gap)
        opened, largest = gap + matrix @ forces, np.abs(gap).max()
        assert change == 0.0
        assert np.all(forces >= 0.0) and np.count_nonzero(forces) > 3
        assert np.all(opened >= -1e-11 * largest)
        assert np.abs(opened * np.diag(matrix) * forces).max() < 1e-11 * largest**2


def test_forces_that_do_not_settle_say_so():
    """Two nodes that push each other more than themselves, both pressed in: every sweep makes it worse."""
    _, change = press_nodes(np.array([[1.0, -1.1], [-1.1, 1.0]]), np.array([-1.0, -1.0]))
    assert change > 0.1


def test_nodes_that_move_as_one_share_their_force():
    """Rows of G that are alike make it singular: there is no single solution, and none of the forces is NaN."""
    forces, change = press_nodes(np.ones((2, 2)), np.array([-1.0, -1.0]))
    assert change == 0.0 and np.all(forces >= 0.0) and forces.sum() == pytest.approx(1.0)


LAW = {
    "elastic": st.floats(1e6, 1e12),
    "plastic": st.floats(0.0, 1e12),
    "yield_stress": st.floats(0.0, 1e9),
    "flexibility": st.floats(0.0, 1e-6),
    "pushes": st.lists(st.floats(-1e-3, 4.9e-3), min_size=1, max_size=10),
}
DEEP = st.lists(st.floats(-1e-3, 3e-2).map(lambda push: round(push, 9)), min_size=1, max_size=10)
AREA = 1e-6


@given(**LAW)
def test_lines_of_a_bar_are_its_return_mapping_in_series(elastic, plastic, yield_stress, flexibility, pushes):
    """Pushed again and again, with a flexibility behind it, never worn through."""
    bar, wear = Lining(5e-3, elastic, plastic, yield_stress, bar_width=1e-3), 0.0
    series = laws.series_modulus(elastic, elastic * AREA / bar.thickness, flexibility)
    line, offset, slope = laws.lines_of_bar(series, AREA, bar)
    for push in pushes:
        stress, expected = laws.return_mapping(push, wear, series, bar)
        scale = line * bar.thickness
        force = max(0.0, min(line * (push - wear), offset + slope * push))
        assert force == pytest.approx(stress * AREA, rel=1e-12, abs=1e-14 * scale)
        # the flexibility takes its part of the push
        worn = laws.worn(push - flexibility * force, wear, bar)
        # a difference of strains that the series divides by what is left to the bar
        assert worn == pytest.approx(expected, rel=1e-9, abs=1e-13 * bar.thickness)
        assert worn >= wear
        wear = float(worn)


@settings(max_examples=200)
@given(**LAW | {"flexibility": st.floats(1e-10, 1e-6), "pushes": DEEP})
def test_a_bar_and_the_casing_behind_it_against_a_root(elastic, plastic, yield_stress, flexibility, pushes):
    """The force p on a node pushed to x: that of the bar at x - R p, and more if it reaches the casing; wear as far as that."""
    lining, wear = Lining(5e-3, elastic, plastic, yield_stress, bar_width=1e-3), 0.0
    for push in pushes:

        def missing(force, push=push, wear=wear):
            return force - AREA * laws.return_mapping(push - flexibility * force, wear, elastic, lining)[0]

        largest = abs(push) / flexibility
        on_bar = brentq(missing, 0.0, largest, xtol=1e-14 * largest) if push > wear else 0.0
        behind, expected = push - flexibility * on_bar - lining.thickness, max(on_bar, (push - lining.thickness) / flexibility)
        worn = laws.return_mapping(min(push - flexibility * expected, lining.thickness), wear, elastic, lining)[1]
        forces, change, new, touching = press_nodes([[flexibility]], [-push], lining, AREA, wear)
        assert change == 0.0
        assert forces[0] == pytest.approx(expected, rel=0, abs=1e-11 * largest)
        assert new[0] == pytest.approx(worn, rel=0, abs=1e-9 * lining.thickness)
        if abs(behind) > 1e-8 * lining.thickness:
            assert touching[0] == (behind > 0.0)
        wear = float(new[0])


@settings(max_examples=100)
@given(st.integers(0, 2**31 - 1), st.integers(1, 19))
def test_bars_and_casing_of_several_nodes_each_have_the_force_of_their_law(seed, n):
    """Bars that were worn before, softer and stiffer than what holds the nodes; some reach the casing."""
    generator = np.random.default_rng(seed)
    matrix, gap = opening_of_nodes(generator, n), 1e-4 * generator.standard_normal(n)
    modulus = 10.0 ** generator.uniform(8, 14)
    lining = Lining(5e-5, modulus, 0.3 * modulus, 1e-3 * modulus, bar_width=1e-3)
    wear = generator.uniform(0.0, 4e-5, n)
    forces, change, new, touching = press_nodes(matrix, gap, lining, AREA, wear)
    assert change == 0.0
    by_sweeps, *_ = press_nodes(matrix, gap, lining, AREA, wear, by_sweeps=True)
    np.testing.assert_allclose(by_sweeps, forces, rtol=0, atol=1e-9 * np.abs(forces).max())
    depth = -(gap + matrix @ forces)
    largest = np.abs(gap).max()
    assert np.all(depth <= lining.thickness + 1e-10 * largest)
    for k in range(n):
        of_bar, worn = laws.return_mapping(min(depth[k], lining.thickness), wear[k], modulus, lining)
        own = np.diag(matrix)[k]
        if touching[k]:
            assert depth[k] == pytest.approx(lining.thickness, rel=0, abs=1e-8 * lining.thickness)
            assert forces[k] >= of_bar * AREA - 1e-8 * largest * min(1.0 / own, modulus * AREA / lining.thickness)
        else:
            # as far as the force moves bar or node
            compliance = own + lining.thickness / modulus / AREA
            assert abs(forces[k] - of_bar * AREA) * own * lining.thickness / modulus / AREA / compliance < 1e-10 * largest
        assert new[k] == pytest.approx(worn, rel=0, abs=1e-8 * lining.thickness)


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
    assert casing_axes(np.array([0.0, 0.0, 1.0]), ANGLE)[0] == pytest.approx(0.263, abs=1e-3)


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
    start = MotionAtStart(np.array([-3e-4, -3e-4]))
    (_, state, record), (_, alone, _) = (
        whole_run(model, 1000.0, Scene(Casing(clearance, lobes=0), damping_ratio=0.0), choice, start)
        for clearance in (1e-4, 1.0)
    )
    assert state.totals["steps_in_contact"] > 0
    assert state.displacement[1] == pytest.approx(alone.displacement[1], rel=1e-9)
    assert abs(state.displacement[0] - alone.displacement[0]) > 1e-5
    assert record.samples[:, 0].max() <= 1e-4 * (1 + 1e-9)


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
