"""Clearance that changes with the speed: where rotation holds the blade, what contact makes of it, the stress of rotation."""

import re
from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp
from box_mesh import box_mesh
from defaults import IntegrationChoice
from integration_cases import ABRADABLE, DIRECT, LINING, random_model, with_static_modes
from integration_runs import ENGINES, whole_run

from r37core.base.yaml_file import load_yaml
from r37core.config import ConfigError, checked_scene
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.fem.solver import factorise
from r37core.product.extensions import load_settings
from r37core.rom.contact_model import read_contact_model, write_contact_model
from r37core.rom.reduced_model import contact_model
from r37core.rom.rotation import BucklingError, rotation_amplitudes, shapes_of_rotation
from r37core.time_integration.clearance import NoRoomError, check_room, clearances, growth
from r37core.time_integration.problem import Problem
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed

SHORT = IntegrationChoice(4e-7, 3, 62, integrator="exact_modal")
NARROW = replace(ABRADABLE, lining=replace(LINING, bar_area=1.6e-7))
COLD = {"cold_m": 3.56e-4}
KEPT = {"spectrum_highest_order": 5, "wear_angles": 60}


def growing(scene, **others):
    return replace(scene, casing=replace(scene.casing, centrifugal=True, **others))


def random_blade(nodes):
    """A random blade with static modes."""
    return with_static_modes(random_model(nodes), 1e-9)


def moved(nodes, size=2e-5, stiffening=(0.0, 2e-7), blade=random_blade):
    """A random blade whose nodes rotation moves, each its own way; at 1000 rad/s by about `size` (m)."""
    generator = np.random.default_rng(5)
    shapes = generator.standard_normal((3, nodes, len(stiffening))) * size * 1e-6
    return replace(blade(nodes), rotation_shapes=shapes, rotation_stiffening=np.array(stiffening))


@pytest.mark.parametrize("scene", [ABRADABLE, DIRECT], ids=["lined", "bare"])
def test_a_table_over_revolutions_ends_contact_where_it_opens(scene):
    """A table of zeros has the bits of none; one that opens by a centimetre in the fourth revolution leaves none after it."""
    steps = {}
    for name, change in (("none", ()), ("zeros", (0.0, 0.0, 0.0)), ("opens", (0.0, 0.0, 0.01))):
        casing = replace(scene.casing, rise_fraction=0.0, change_revolutions=(0.0, 3.0, 4.0)[: len(change)], change=change)
        simulation = Simulation(random_blade(3), 1000.0, replace(scene, casing=casing), replace(SHORT, revolutions=7))
        state, found = simulation.start(), []
        for _ in range(7):
            record = simulation.advance(state, 1)
            found.append((float(state.totals["steps_in_contact"]), record.samples.tobytes(), state.wear.tobytes()))
        steps[name] = found
    assert steps["zeros"] == steps["none"] and steps["opens"][:3] == steps["none"][:3]
    contact = np.array([found[0] for found in steps["opens"]])
    assert contact[0] > 0.0 and np.all(contact[4:] == contact[3]) and steps["none"][6][0] > contact[6]


@pytest.mark.slow
def test_the_gap_follows_the_table_in_both_engines():
    casing = replace(DIRECT.casing, rise_fraction=0.0, change_revolutions=(0.0, 1.0, 2.5), change=(0.0, 1e-4, -2e-5))
    for scene in (replace(DIRECT, casing=casing), replace(ABRADABLE, casing=casing)):
        runs = [run_of(random_blade(3), scene, engine=engine) for engine in ENGINES]
        (found, totals), (expected, expected_totals) = runs
        assert totals["steps_in_contact"] == expected_totals["steps_in_contact"] > 0
        assert totals["friction_heat"] == pytest.approx(expected_totals["friction_heat"], rel=1e-5) != 0.0
        # a block that begins without contact measures its gaps anew
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-6 * np.abs(expected).max())
    np.testing.assert_allclose(casing.change_at(np.array([0.5, 1.0, 1.75, 9.0])), [5e-5, 1e-4, 4e-5, -2e-5])
    # a motion that is carried on has the clearance that it ended in
    grown = replace(DIRECT, casing=casing).grown.casing
    np.testing.assert_allclose(grown.change_at(np.array([0.0, 1.0, 9.0])), -2e-5)
    assert DIRECT.grown.casing.change == ()


def run_of(model, scene, choice=SHORT, engine="compiled"):
    """Samples and totals of a run at 1000 rad/s."""
    _, state, record = whole_run(model, 1000.0, scene, choice, engine=engine)
    return record.samples, state.totals


def assert_alike(found, expected, within):
    """Samples of two runs, `within` a part of the largest, which is a motion."""
    assert np.abs(expected).max() > 1e-9
    np.testing.assert_allclose(found, expected, rtol=0, atol=within * np.abs(expected).max())


def test_a_bar_on_the_axis_is_stretched_as_in_closed_form():
    """u(b) = rho Omega^2/(2 E) (b^2 (b - a) - (b^3 - a^3)/3): slender, between the radii a and b, Poisson's ratio 0."""
    a, b, density, modulus = 0.1, 0.3, 8000.0, 180e9
    mesh = box_mesh(b - a, 0.01, 0.01, (8, 1, 1), origin=(a, -0.005, -0.005))
    matrices = assemble(mesh, Material(modulus, density, 0.0, 1e9))
    free = matrices.free_nodes
    load = matrices.centrifugal_load[free].ravel()
    displaced = matrices.solve_at_rest(load)[:, None]
    shapes, _ = shapes_of_rotation(matrices.stiffness(), matrices.geometric_stiffness(), displaced, load)
    np.testing.assert_allclose(shapes, displaced, rtol=1e-9, atol=1e-12 * abs(displaced).max())
    tip = np.isclose(mesh.points[free, 0], b)
    expected = density / (2.0 * modulus) * (b**2 * (b - a) - (b**3 - a**3) / 3.0)
    assert shapes.reshape(-1, 3)[tip, 0] == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("spin_softening", [False, True])
def test_shapes_of_a_few_speeds_give_the_displacement_at_any(matrices, reduced, spin_softening):
    model = reduced(spin_softening=spin_softening, recover_whole_blade=True)
    per_square = matrices.geometric_stiffness() + (matrices.spin_softening() if spin_softening else 0.0 * matrices.mass())
    load = matrices.centrifugal_load[matrices.free_nodes].ravel()
    for speed in (200.0, 900.0, 1730.0, 2000.0):
        solve = factorise(sp.csr_array(matrices.stiffness() + speed**2 * per_square))
        exact = speed**2 * solve(load)
        found = model.whole_blade.rotation_shapes @ rotation_amplitudes(model.rotation_stiffening, speed)
        np.testing.assert_allclose(found[matrices.free_nodes].ravel(), exact, rtol=0, atol=1e-4 * abs(exact).max())
    # a stiffness that does not change with the speed would give 1.3 times the displacement
    assert np.ptp(model.rotation_stiffening) * 1730.0**2 > 0.05


def test_nodes_are_where_rotation_holds_them(model, tmp_path):
    """Radius, angle, directions and distance from the cone of the displaced nodes themselves."""
    speed, contact = 1730.0, contact_model(model, "pressure_edge")
    nodes = model.contact_nodes
    x, y, z = (nodes.points + nodes.rotation_shapes @ rotation_amplitudes(model.rotation_stiffening, speed)).T
    write_contact_model(contact, tmp_path / "contact.npz")
    spun = read_contact_model(tmp_path / "contact.npz").spun(speed)
    np.testing.assert_allclose(spun.radius, np.hypot(x, y), rtol=1e-14)
    np.testing.assert_allclose(spun.theta, np.arctan2(y, x), rtol=1e-12)
    assert np.abs(spun.theta - contact.theta).max() > 1e-4
    outwards = np.stack([np.cos(spun.theta), np.sin(spun.theta)], axis=1)
    modal = nodes.basis @ contact.to_reduced
    np.testing.assert_allclose(spun.displacement_operator[0], np.einsum("ni,nim->nm", outwards, modal[:, :2]), atol=1e-13)
    np.testing.assert_allclose(spun.displacement_operator[2], modal[:, 2], atol=1e-13)
    angle = -0.3
    cold_x, cold_y, cold_z = nodes.points.T
    # signed distance from a cone, along its normal
    distance = np.cos(angle) * np.hypot(x, y) - np.sin(angle) * z
    before = np.cos(angle) * np.hypot(cold_x, cold_y) - np.sin(angle) * cold_z
    np.testing.assert_allclose(growth(contact, np.array([speed]), angle)[0], distance - before, rtol=0, atol=1e-15)
    np.testing.assert_array_equal(growth(contact, np.array([0.0]), angle), 0.0)


def test_rotation_that_leaves_no_stiffness_is_refused():
    assert rotation_amplitudes(np.array([-1e-6]), 900.0)[0] == pytest.approx(900.0**2 / 0.19)
    with pytest.raises(BucklingError, match="no stable position at 1000 rad/s"):
        rotation_amplitudes(np.array([1e-7, -1e-6]), np.array([900.0, 1000.0, 2000.0]))


@pytest.mark.slow
@pytest.mark.parametrize("exact_gap", [False, True])
@pytest.mark.parametrize("scene", [NARROW, DIRECT], ids=["abradable", "direct"])
def test_a_growing_blade_is_the_grown_one(scene, exact_gap):
    """Its run is that of a blade whose nodes are there from the first, and whose growth the casing makes room for or not."""
    model, speed = moved(1), 1000.0
    grown = model.spun(speed)
    nearer = growth(model, np.array([speed]), model.tip_cone_angle)[0, 0]
    assert abs(nearer) > 1e-6
    # lobes as high
    cold = scene.casing.clearance
    casing = replace(scene.casing, clearance=cold - nearer, amplitude=scene.casing.amplitude * cold / (cold - nearer))
    scene = replace(scene, exact_gap=exact_gap)
    assert_alike(run_of(model, growing(scene))[0], run_of(grown, replace(scene, casing=casing))[0], 1e-9)


@pytest.mark.parametrize("scene", [NARROW, DIRECT], ids=["abradable", "direct"])
def test_a_growing_casing_is_the_wider_one(scene):
    model = random_blade(3)
    wide = replace(scene.casing, growth_speeds=(0.0, 800.0, 1200.0), growth=(0.0, 2e-5, 6e-5))
    same = replace(scene.casing, clearance=scene.casing.clearance + 4e-5)
    same = replace(same, amplitude=scene.casing.lobe_height / same.clearance)
    assert_alike(*(run_of(model, replace(scene, casing=casing))[0] for casing in (wide, same)), 1e-9)


SCENES = {
    "abradable": growing(NARROW),
    "abradable_exact": growing(replace(NARROW, exact_gap=True)),
    "direct": growing(DIRECT),
    "direct_exact": growing(replace(DIRECT, exact_gap=True)),
    # the tip cuts its way into the lining before anything vibrates
    "pressed_in": growing(NARROW, clearance=1e-6, amplitude=20.0),
}


@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["exact_modal", "central_difference"])
@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_compiled_engine_is_the_reference(scene, integrator):
    """With nodes that rotation moves each its own way, and so another clearance at each."""
    blade = random_blade if integrator == "exact_modal" else random_model
    model, choice = moved(5, size=4e-5, blade=blade), replace(SHORT, time_step=6e-7, integrator=integrator, revolutions=1)
    assert np.ptp(clearances(model, scene, np.array([1000.0]))) > 1e-5
    runs = [run_of(model, scene, choice, engine) for engine in ENGINES]
    (found, totals), (expected, expected_totals) = runs
    assert totals["steps_in_contact"] == expected_totals["steps_in_contact"] > 0
    assert_alike(found, expected, 1e-7)


def test_energy_closes_where_the_tip_is_pressed_in():
    scene = growing(NARROW, clearance=1e-6, amplitude=30.0)
    model = moved(4, size=5e-5)
    assert clearances(model, scene, np.array([1000.0])).min() < 0.0
    kept = run_speed(model, 1000.0, scene, SHORT, ["energy", "wear"], **KEPT)
    # its own track, all round
    assert kept["wear"].min() > 1e-6
    scale = np.abs([kept["contact_work"], kept["damping_loss"]]).max()
    assert abs(kept["energy_residual"]) < 1e-9 * scale
    np.testing.assert_array_equal(kept["clearance"], Problem(model, 1000.0, scene, SHORT).casing.clearance)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_tip_in_the_lining_of_a_round_casing_lies_still(engine):
    """It has cut its way before: the lining is worn by as much as each node reaches into it, and presses nothing."""
    scene = growing(NARROW, clearance=0.0, lobes=0)
    simulation = ENGINES[engine](moved(4, size=5e-5), 1000.0, scene, replace(SHORT, time_step=2e-6))
    state = simulation.start()
    assert not simulation.advance(state, 1).samples.any()
    depth = np.maximum(-simulation.problem.casing.clearance, 0.0)
    assert depth.max() > 1e-5 and depth.min() == 0.0
    np.testing.assert_array_equal(state.wear, np.repeat(depth[:, None], simulation.problem.casing.bars, axis=1))


def test_a_tip_inside_of_the_casing_is_refused():
    """With a lining in front of it as well, where the tip is pressed in by more than that is thick."""
    model = moved(4, size=5e-5)
    direct = growing(DIRECT, clearance=2e-5)
    found = r"casing\.clearance of the scene.*: at 1000 rad/s contact node \d of 4.* is \S+ m inside of the casing"
    with pytest.raises(NoRoomError, match=rf"{found}.*; allowed: a cold_m of at least (\S+) m for") as refused:
        Problem(model, 1000.0, direct, SHORT)
    enough = float(re.search(r"at least (\S+) m", str(refused.value))[1])
    check_room(model, growing(DIRECT, clearance=enough * (1.0 + 1e-5)), np.array([1000.0]))
    lined = growing(NARROW, clearance=0.0)
    Problem(model, 1000.0, lined, SHORT)
    with pytest.raises(NoRoomError):
        Problem(model, 1000.0, replace(lined, lining=replace(LINING, thickness=1e-6)), SHORT)


def static_displacement(model, speed):
    """Displacement (m) of the box's nodes by rotation alone, at one instant."""
    shapes = model.stress_regions["box"].nodes.rotation_shapes
    return (shapes @ rotation_amplitudes(model.rotation_stiffening, speed))[:, :, None]


def casing_of(**clearance):
    return checked_scene({"casing": {"lobes": 0} | clearance}).casing


def growth_of(**table):
    return {"clearance": COLD | {"casing_growth": table}}


def test_keys_reach_their_fields():
    assert casing_of(clearance=COLD) == replace(casing_of(clearance_m=3.56e-4), centrifugal=True)
    assert not casing_of(clearance=COLD | {"centrifugal": False}).changes_with_speed
    growth = casing_of(**growth_of(speeds_rpm=[0, 30.0, 60.0], growth_m=[0.0, 1e-5, -2e-5]))
    assert growth.growth_speeds == pytest.approx((0.0, np.pi, 2.0 * np.pi))
    assert growth.opening(np.array([0.5, 1.5, 2.0]) * np.pi) == pytest.approx([0.5e-5, -0.5e-5, -2e-5])
    with pytest.raises(ValueError, match=r"casing_growth: given up to 6\.28\d* rad/s; needed up to 7 rad/s"):
        growth.opening(np.array([1.0, 7.0]))


def test_growth_of_a_casing_reaches_the_highest_speed(config_copy):
    file = config_copy / "config/scenes.yaml"
    table = "casing_growth: { speeds_rpm: [0, 9000], growth_m: [0, 1.0e-5] }"
    first = "clearance: { cold_m: 3.56e-4 } }\n"
    file.write_text(file.read_text().replace(first, f"clearance: {{ cold_m: 3.56e-4, {table} }} }}\n", 1))
    load_settings(load_yaml(config_copy / "config/config.yaml"), config_copy)
    config = load_yaml(config_copy / "config/config.yaml") | {"scenes": ["growing_abradable"]}
    found = r"growing_abradable\.casing\.clearance\.casing_growth: found growth up to 942\.478 rad/s; allowed: up to "
    with pytest.raises(ConfigError, match=rf"{found}structure\.maximum_speed_rad_s, 2000 rad/s \(19098\.6 rpm\)"):
        load_settings(config, config_copy)
    fast = config | {"speeds": [900, 950], "structure": config["structure"] | {"maximum_speed_rad_s": 900}}
    with pytest.raises(ConfigError, match=rf"{found}the fastest of its speeds, 950 rad/s"):
        load_settings(fast, config_copy)
