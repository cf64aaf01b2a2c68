"""The largest penetration of the tip's edge: by hand, and of both engines."""

from dataclasses import replace

import numpy as np
import pytest
from defaults import Casing, Friction, IntegrationChoice, Scene
from integration_cases import AT_ONCE, DIRECT, LINING, RING, SCENES, oscillator, random_model, with_modes, with_static_modes
from integration_runs import ENGINES, both_engines, whole_run
from reference_engine import complementary

import r37
from r37core.contact.scene import Rotor
from r37core.time_integration.initial_motion import InitialMotion
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.problem import Problem
from r37core.time_integration.simulate import Simulation, rest_state
from r37core.time_integration.speed_run import run_speed


def with_edge(model, nodes):
    """The model with an edge of so many nodes between its contact nodes, and beyond them by half a distance."""
    place = np.linspace(-0.5, len(model.theta) - 0.5, nodes)
    low = np.clip(np.floor(place), 0, max(len(model.theta) - 2, 0)).astype(int)
    high, share = np.minimum(low + 1, len(model.theta) - 1), place - low

    def along(values):
        shape = (-1,) + (1,) * (values.ndim - 1)
        return values[low] * (1.0 - share).reshape(shape) + values[high] * share.reshape(shape)

    def of_nodes(operator):
        return np.moveaxis(along(np.moveaxis(operator, 1, 0)), 0, 1)

    return replace(
        model,
        edge_displacement_operator=of_nodes(model.displacement_operator),
        edge_radius=along(model.radius),
        edge_theta=along(model.theta),
        edge_rotation_shapes=of_nodes(model.rotation_shapes),
    )


def with_moving_edge(model, factors):
    """The model of one node with an edge that moves by these factors as far as the node."""
    return replace(
        model,
        edge_displacement_operator=model.displacement_operator * factors[:, None],
        edge_radius=np.full(len(factors), 0.25),
        edge_theta=np.linspace(0.0, 1.0, len(factors)),
        edge_rotation_shapes=np.zeros((3, len(factors), 1)),
    )


@pytest.mark.slow
@pytest.mark.parametrize("integrator", [CENTRAL_DIFFERENCE, EXACT_MODAL])
@pytest.mark.parametrize(("engine", "nodes"), [("compiled", 2), ("compiled", 50), ("reference", 50)])
def test_an_edge_that_moves_further_than_its_contact_node(engine, integrator, nodes):
    """A stop holds the contact node, and an edge that moves up to half as much again passes it by half of the clearance.

    With forces at t_n a part of it is the static modes', which move the edge as much more.
    """
    stop, model = 0.5e-3, oscillator(5000.0)
    if integrator == EXACT_MODAL:
        model = with_static_modes(model, 1e-9)
    model = with_moving_edge(model, np.linspace(1.5, -1.0, nodes))
    scene = Scene(Casing(stop, lobes=0), damping_ratio=0.0)
    choice = IntegrationChoice(1e-7, 1, 100, integrator=integrator)
    _, state, _ = whole_run(model, 10000.0, scene, choice, InitialMotion(np.array([-1e-3]), None), engine)
    assert state.totals["steps_in_contact"] > 0
    assert state.totals["largest_penetration"] == pytest.approx(0.5 * stop, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("integrator", [CENTRAL_DIFFERENCE, EXACT_MODAL])
def test_an_edge_that_passes_a_thin_lining_before_its_contact_node(integrator):
    """The node stays in the first half of a stiff lining, and an edge that moves five times as far passes the casing."""
    model = oscillator(5000.0) if integrator == CENTRAL_DIFFERENCE else with_static_modes(oscillator(5000.0), 1e-9)
    model = with_moving_edge(model, np.linspace(5.0, 1.0, 50))
    lining = replace(LINING, thickness=1e-3, elastic_modulus=20e9, contact_length=1e-4, bar_width=None)
    scene, start = Scene(Casing(1e-4, lobes=0), lining, damping_ratio=0.0), InitialMotion(np.array([-5e-4]), None)
    choice = IntegrationChoice(1e-7, 1, 100, integrator=integrator)
    ours, theirs = (
        whole_run(model, 10000.0, scene, choice, start, engine)[1].totals["largest_penetration"] for engine in ENGINES
    )
    assert theirs > 1e-4
    assert ours == pytest.approx(theirs, rel=1e-6)


def test_an_edge_inside_the_casing_at_rest_is_recorded():
    """Rotation brings a blade's edge into a bare casing, and its contact nodes not: nothing touches."""
    model = with_edge(with_static_modes(random_model(8), 1e-9), 40)
    shapes = np.zeros((3, 40, 1))
    shapes[0, -1] = 1.5e-9
    nothing = {"rotation_shapes": np.zeros((3, 8, 1)), "rotation_stiffening": np.zeros(1)}
    model = replace(model, edge_rotation_shapes=shapes, **nothing)
    casing = replace(DIRECT.casing, lobes=0, centrifugal=True, clearance=1e-3)
    choice = IntegrationChoice(2e-7, 1, 31, integrator=EXACT_MODAL)
    problem = Problem(model, 1000.0, replace(DIRECT, casing=casing), choice)
    assert rest_state(problem).totals["largest_penetration"] == pytest.approx(1.5e-3 * np.cos(0.26) - 1e-3, rel=1e-3)


@pytest.mark.parametrize("contact", ["direct", "abradable"])
def test_an_edge_that_does_not_reach_the_casing(contact):
    """Nodes that do not move stay clear; nor does one that passes the lining's surface but not the casing behind it."""
    model = with_edge(with_static_modes(random_model(8), 1e-9), 40)
    if contact == "direct":
        model = replace(model, edge_displacement_operator=0.0 * model.edge_displacement_operator)
        scene = replace(DIRECT, casing=replace(AT_ONCE, amplitude=0.5))
    else:
        scene = SCENES["abradable"]
    for _, state, _ in both_engines(model, 12_000.0, scene, IntegrationChoice(2e-7, 1, 31, integrator=EXACT_MODAL)):
        assert state.totals["largest_penetration"] == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("integrator", [CENTRAL_DIFFERENCE, EXACT_MODAL])
@pytest.mark.parametrize("scene", ["direct", "direct_exact", "thin_lining", "elastic", "coriolis"])
def test_both_engines_find_the_same_penetration(scene, integrator):
    model = random_model(8)
    if integrator == EXACT_MODAL:
        model = with_static_modes(model, 1e-9)
    elif scene in ("coriolis", "elastic"):
        pytest.skip("central differences carry no Coriolis force, and step a casing in other tests")
    if scene == "coriolis":
        modes = len(model.squared_frequencies)
        coupling = np.zeros((modes, modes))
        coupling[:24, :24] = np.random.default_rng(9).standard_normal((24, 24))
        model = replace(model, coriolis=3.0 * (coupling - coupling.T))
    surroundings = {"elastic": replace(DIRECT, casing=replace(AT_ONCE, ring=RING.modes())), "coriolis": DIRECT} | SCENES
    choice = IntegrationChoice(2e-7, 1, 31, integrator=integrator)
    (_, ours, _), (_, theirs, _) = both_engines(with_edge(model, 50), 12_000.0, surroundings[scene], choice)
    assert theirs.totals["largest_penetration"] > 1e-6
    assert ours.totals["largest_penetration"] == pytest.approx(theirs.totals["largest_penetration"], rel=1e-6)


@pytest.mark.parametrize("friction", [0.0, 0.15])
def test_forces_of_twenty_patches_are_those_of_the_complementarity_problem(friction):
    """Static modes move neighbours together: after each sample the forces are those of Murty's rule on the gaps there."""
    nodes, scene = 20, replace(DIRECT, friction=Friction(friction) if friction else None)
    place, chosen = np.linspace(0.0, 1.0, nodes), IntegrationChoice(4e-7, 1, 62, integrator=EXACT_MODAL)
    near = np.zeros((3, nodes, nodes))
    near[0] = 1.2e-5 * np.exp(-20.0 * (place[:, None] - place) ** 2)
    model = with_modes(with_static_modes(random_model(nodes), 1e-9), 1e8, near)
    simulation = Simulation(model, 12_000.0, scene, chosen)
    state, engine, found = simulation.start(), simulation.engine, 0
    assert not simulation.problem.blade.settles_at_once
    for _ in range(62):
        simulation.advance_samples(state, 1)
        pressure = -state.contact_force[0]
        if not np.any(pressure > 0.0):
            continue
        share = np.divide(state.contact_force[1:], pressure, out=np.zeros((2, nodes)), where=pressure > 0.0)
        directions = np.stack([-np.ones(nodes), *share])
        listed = pressure > 0.0
        matrix = -np.einsum("dk,dkg->gk", directions, simulation.problem.contact.contact_flexibility)
        gap = engine.record[0]["problem"]["gap"][:nodes].copy()
        # of the nodes that touch the direction of friction is known
        expected = complementary(matrix[np.ix_(listed, listed)], gap[listed])
        np.testing.assert_allclose(pressure[listed], expected, rtol=1e-6, atol=1e-9 * expected.max())
        assert np.all((gap + matrix @ pressure)[~listed] > -1e-11)
        found += listed.sum() > 2
    assert found > 3 and state.totals["worst_complementarity"] == 0.0


@pytest.mark.slow
def test_a_run_has_it_from_model_to_dataset(config):
    """The benchmark's blade on patches and points, in the lining and in bare casing: only there its edge passes the casing."""
    found = {}
    for contact in ("points", "patches"):
        blade = r37.blade("Ref", contact=contact, config=config)
        for name in ("direct", "abradable"):
            scene = r37.scene(name, config=config, revolutions=100)
            found[name, contact] = r37.simulate(blade, scene, 1330.0, results=[]).largest_penetration.item()
    assert found["abradable", "points"] == found["abradable", "patches"] == 0.0
    # a tenth of the clearance to all of it, and fewer on short end patches
    assert 3e-5 < found["direct", "patches"] < 0.5 * found["direct", "points"] < 5e-4


def test_a_rotor_has_the_largest_of_its_blades():
    """The longer blade has less clearance, and goes through the casing by as much more than the blade alone."""
    model = with_edge(with_static_modes(random_model(8), 1e-9), 40)
    choice, scene = IntegrationChoice(2e-7, 2, 31, integrator=EXACT_MODAL), SCENES["thin_lining"]
    arguments = dict(spectrum_highest_order=5, wear_angles=10)
    longer = replace(scene, casing=replace(scene.casing, longer=5e-5))
    alone = [float(run_speed(model, 12_000.0, one, choice, (), **arguments)["largest_penetration"]) for one in (scene, longer)]
    rotor = Rotor((1, 2), (0.0, np.pi), (1.0, 1.0), (0.0, 5e-5), shared_lining=False)
    both = run_speed(model, 12_000.0, replace(scene, rotor=rotor), choice, (), **arguments)
    assert alone[0] != alone[1]
    assert float(both["largest_penetration"]) == pytest.approx(max(alone), rel=0.1)


def test_contact_nodes_are_the_edge_where_no_other_is_known():
    """Contact nodes in bare casing keep clear of it, to round-off, with forces that correct the prediction."""
    choice = IntegrationChoice(2e-7, 1, 31)
    for _, state, _ in both_engines(random_model(8), 12_000.0, DIRECT, choice):
        assert state.totals["steps_in_contact"] > 100
        assert state.totals["largest_penetration"] < 1e-12
