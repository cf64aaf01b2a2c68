"""A flexible casing: closed forms of rings, the frame that does not turn, SciPy, energy, limits, files and refusals."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from defaults import Casing, Friction, IntegrationChoice, Scene
from integration_cases import ABRADABLE, ELASTIC, SCENES, oscillator, random_model, with_static_modes
from integration_cases import RING as STEEL
from integration_runs import ENGINES, assert_close, assert_same_record, assert_same_state, both_engines, times, whole_run
from reference_motion import turned
from scipy.integrate import solve_ivp

from r37core.base.plain import to_json, to_plain
from r37core.config import ConfigError, checked_scene, command_line_document
from r37core.config.elastic_casings import remarks_on_overtaken_waves
from r37core.config.remarks import remarks_of_pipeline
from r37core.contact.elastic_casing import (
    ElasticCasing,
    flexibility,
    flexibility_of,
    nodal_diameters_for,
    shortest_met,
    slowest_wave,
)
from r37core.contact.ring import RingMode, RingMotion, critical_speed
from r37core.figures.campbell_diagram import draw_campbell
from r37core.figures.maps import draw_casing_map
from r37core.product.extensions import read_settings
from r37core.results.casing_coincidence import coincidence_table, coincidences, seen_from_rotor, waves_of
from r37core.results.datasets import write_sweep_dataset
from r37core.results.response import write_response
from r37core.time_integration.clearance import NoRoomError
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.kept_numbers import casing_waves
from r37core.time_integration.problem import Problem, UnstableStepError
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.speed_run import run_speed

CHOICE = IntegrationChoice(2e-7, 1, 62, integrator=EXACT_MODAL)

FLANGED = replace(STEEL, radial_foundation=1e9, tangential_foundation=1e9)
"""The shipped ring but for its damping."""


def casing_of(ring, number):
    ring = replace(ring, highest_nodal_diameter=number)
    return ElasticCasing(ring.modes(), ring)


def random_blade():
    """Eight nodes, held by static modes."""
    return with_static_modes(random_model(8), 1e-9)


def with_ring(scene, modes):
    return replace(scene, casing=replace(scene.casing, ring=tuple(modes)))


ELASTIC_SCENES = {name: with_ring(scene, STEEL.modes()) for name, scene in SCENES.items() if not scene.exact_gap}


def test_two_opposite_forces_stretch_a_free_ring_as_timoshenko_says():
    """The diameter under two forces F along it: (pi/4 - 2/pi) F R^3/(E I) (Timoshenko, Strength of Materials, curved bars)."""
    ring = replace(STEEL, radial_foundation=0.0, tangential_foundation=0.0, highest_nodal_diameter=400)
    bending = [mode for mode in ring.modes() if mode.nodal_diameter]
    assert [mode.nodal_diameter for mode in bending] == list(range(2, 401))
    motion = RingMotion(tuple(bending))
    rows = motion.displacement(np.array([0.0, np.pi]))[0]
    stretched = np.sum(rows.sum(axis=0) ** 2 / motion.frequencies**2)
    inertia = ring.width * ring.thickness**3 / 12.0
    expected = (np.pi / 4.0 - 2.0 / np.pi) * ring.radius**3 / (ring.elastic_modulus * inertia)
    assert stretched == pytest.approx(expected, rel=1e-6)


def test_a_rigid_translation_has_the_mass_of_the_ring_and_of_its_foundation_the_stiffness():
    mode = next(one for one in STEEL.modes() if one.nodal_diameter == 1)
    mass = 2.0 * np.pi * STEEL.radius * STEEL.thickness * STEEL.width * STEEL.density
    assert mode.modal_mass == pytest.approx(mass)
    stiffness = np.pi * STEEL.radius * (STEEL.radial_foundation + STEEL.tangential_foundation)
    assert mode.frequency == pytest.approx(np.sqrt(stiffness / mass))
    moved = RingMotion((mode,)).displacement(np.array([0.3]))[:, 0, 0] * np.sqrt(mass)
    np.testing.assert_allclose(moved, [np.cos(0.3), -np.sin(0.3), 0.0], atol=1e-15)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "step"), [*((name, 1.2e-6) for name in ELASTIC_SCENES), ("abradable", 2e-7)])
def test_compiled_time_integration_is_the_reference(name, step):
    """In the rotor's frame by pairs that turn, and in the frame that does not turn with nodes that go round."""
    choice = replace(CHOICE, time_step=step, snapshots_per_revolution=62, snapshot_revolutions=1)
    found = []
    for simulation_class in ENGINES.values():
        simulation = simulation_class(random_blade(), 6000.0, ELASTIC_SCENES[name], choice)
        state = simulation.start()
        # stopped in the middle of a revolution
        records = [simulation.advance_samples(state, count) for count in (25, 37)]
        found.append((state, records, simulation.energy(state), simulation.work(state)))
    (ours, parts, energy, work), (theirs, plain, *_) = found
    for part, expected in zip(parts, plain, strict=True):
        assert_same_record(part, expected)
    for kind in ("displacement", "increment"):
        assert_close(getattr(ours, kind), getattr(theirs, kind), 1e-9)
    assert ours.totals["steps_in_contact"] > 100
    # forces settle to a share of the gap, here many times the lining
    assert_same_state(ours, theirs, within=1e-9)
    loss = ours.totals["loss"]
    assert abs(energy - work + loss) < 1e-10 * (abs(work) + loss)


@pytest.mark.parametrize("name", ["direct", "abradable"])
def test_published_scheme_carries_the_casing(name):
    choice = replace(CHOICE, integrator=CENTRAL_DIFFERENCE, time_step=1e-7)
    (_, ours, record), (_, theirs, plain) = both_engines(random_model(8), 18_000.0, ELASTIC_SCENES[name], choice)
    assert_same_record(record, plain)
    assert_same_state(ours, theirs)


@pytest.mark.parametrize("name", ["direct", "abradable", "thin_lining"])
def test_a_casing_of_great_mass_is_rigid(name):
    heavy = with_ring(SCENES[name], [replace(mode, modal_mass=1e15) for mode in STEEL.modes()])
    elastic, rigid = (whole_run(random_blade(), 3000.0, scene, CHOICE)[2].samples for scene in (heavy, SCENES[name]))
    assert_close(elastic, rigid, 1e-10)


MOVING = (RingMode(0, 9000.0, 0.5, 0.1), RingMode(2, 3000.0, 0.8, 0.1, 1.0, 0.5), RingMode(5, 6000.0, 1.2, 0.05, 1.0, 0.2))
PRESSED = Scene(Casing(-1e-4, lobes=0, rise_fraction=0.0), ELASTIC, damping_ratio=0.05, divergence_limit=1.0)


# of both modes: below, at the critical speed of the second one, between, at that of the first one, above
@pytest.mark.parametrize("speed", [600.0, 1200.0, 1350.0, 1500.0, 2000.0])
def test_a_load_that_runs_round_the_ring(speed):
    """Steady in the rotor's frame: zeta (omega^2 - n^2 Omega^2 + 2 i xi omega n Omega) = f, at critical speeds, too."""
    flexibility = 2e-7
    model = with_static_modes(replace(oscillator(2e4), theta=np.array([0.7])), flexibility)
    choice = replace(CHOICE, time_step=1e-6, revolutions=40)
    simulation, _, record = whole_run(model, speed, with_ring(PRESSED, MOVING), choice)
    n, frequency, mass, ratio, *_ = np.array([list(vars(mode).values()) for mode in MOVING]).T
    force_to_wave = np.exp(-1j * n * 0.7) / mass / (frequency**2 - (n * speed) ** 2 + 2j * ratio * frequency * n * speed)
    given_way = np.sum(force_to_wave * np.exp(1j * n * 0.7)).real
    force = 1e-4 / (1.0 / simulation.problem.casing.lining_stiffness[0] + flexibility + given_way + 1.0 / 2e4**2)
    # phase by phase: cosines, then sines
    expected = np.concatenate([(force * force_to_wave).real, -(force * force_to_wave).imag])
    assert_close(record.casing[-1], expected, 2e-4)
    np.testing.assert_allclose(record.samples[-1, 0], -force / 2e4**2, rtol=2e-4)


def test_free_waves_keep_their_frequency_and_their_sense():
    """In the frame that does not turn a wave of a mode has the mode's frequency, whichever way it runs."""
    speed, modes = 1300.0, (RingMode(3, 4 * 1300.0, 1.0, 0.0, 1.0, 1.0 / 3.0), RingMode(0, 3 * 1300.0, 1.0, 0.0))
    scene = with_ring(Scene(Casing(1.0, lobes=0), damping_ratio=0.0, divergence_limit=10.0), modes)
    choice = replace(CHOICE, time_step=2e-5, revolutions=40)
    simulation = Simulation(with_static_modes(oscillator(5000.0), 1e-9), speed, scene, choice)
    state, step = simulation.start(), simulation.problem.grid.time_step
    # q_c = cos(omega t), q_s = -sin(omega t): Z = e^(i omega t); and the ring breathes
    state.displacement[1:] = [1e-3, 1e-3, 0.0, 0.0]
    angles = np.array([4, 3]) * speed * step
    state.increment[1:] = 1e-3 * np.concatenate([2.0 * np.sin(0.5 * angles) ** 2, [-np.sin(angles[0]), 0.0]])
    record = simulation.advance(state, 40)
    found = casing_waves(record.casing, simulation.problem.casing.ring, speed, 40, 20)
    peaks = found["casing_order"][found["casing_amplitude"].argmax(axis=1)]
    assert peaks[0] == 4.0 and abs(peaks[1]) == 3.0
    assert found["casing_amplitude"].max(axis=1) == pytest.approx([1e-3, 5e-4], rel=1e-6)
    assert found["casing_rms_forward"] == pytest.approx(np.array([1e-3, 1e-3]) / np.sqrt(2.0))
    assert found["casing_rms_backward"] == pytest.approx([0.0, 0.0], abs=1e-12)
    # kinetic and elastic of q_c and q_s, and of the breathing alone
    energy = [(4 * speed) ** 2 * 1e-6, 0.5 * (3 * speed) ** 2 * 1e-6]
    assert found["casing_energy"] == pytest.approx(energy)
    # that of central differences: cos^2 of half the angle of a step
    assert simulation.energy(state) == pytest.approx(np.cos(0.5 * angles) ** 2 @ energy)


def test_error_on_an_elastic_bar_falls_with_the_square_of_the_step():
    """A node on its bar with friction, and a casing on two modes, in the frame that does not turn: SciPy's DOP853."""
    frequency, speed, coefficient = 3000.0, 1000.0, 0.4
    casing = Casing(-1e-4, lobes=2, amplitude=0.2, rise_fraction=0.0, ring=MOVING)
    scene = replace(PRESSED, friction=Friction(coefficient), casing=casing)
    model, flexibility = replace(oscillator(frequency), displacement_operator=np.array([[[1.0]], [[0.3]], [[0.2]]])), 1e-7
    stiffness = 1.0 / (ELASTIC.thickness / ELASTIC.elastic_modulus / ELASTIC.bar_area + flexibility)
    ring = RingMotion(MOVING)
    own, ratios = (np.concatenate([[one], of]) for one, of in ((frequency, ring.frequencies), (0.05, ring.damping_ratios)))

    def motion(time, state):
        position, velocity = np.split(state, 2)
        theta = np.array([-speed * time])
        rows = np.concatenate([[[1.0], [0.3], [0.2]], -ring.displacement(theta)[:, 0]], axis=1)
        pressed = stiffness * (rows[0] @ position - casing.clearance * (1.0 - 0.2 * casing.shape(theta)[0]))
        assert pressed > 0.0
        sliding = np.array([0.0, -0.25 * speed, 0.0]) + [0.0, 1.0, 1.0] * (rows @ velocity)
        force = rows.T @ (np.array([-pressed, 0.0, 0.0]) - coefficient * pressed * sliding / np.linalg.norm(sliding))
        return np.concatenate([velocity, force - own**2 * position - 2.0 * ratios * own * velocity])

    # whatever the step, of samples there are fifty in a revolution
    time = 2.0 * np.pi / speed / 50 * np.arange(1, 51)
    exact = solve_ivp(motion, (0.0, time[-1]), np.zeros(2 * len(own)), "DOP853", time, rtol=1e-11, atol=1e-16, max_step=1e-5).y
    errors, steps = [], []
    for step in (1.6e-5, 8e-6, 4e-6, 2e-6):
        choice = replace(CHOICE, time_step=step, samples_per_revolution=50)
        simulation = Simulation(with_static_modes(model, flexibility), speed, scene, choice)
        problem, state = simulation.problem, simulation.start()
        pressed = -stiffness * casing.clearance * (1.0 - 0.2 * casing.shape(np.zeros(1))[0])
        state.contact_force[:, 0] = force = pressed * np.array([-1.0, coefficient, 0.0])
        # u(-h) of what moves off from rest under this force
        on_modes = np.einsum("dki,d->i", problem.contact.displacement_operator, force)
        state.increment[:] = -0.5 * problem.contact.recursion.inverse * on_modes
        record = simulation.advance(state, 1)
        np.testing.assert_allclose(times(simulation, 50), time, rtol=1e-12)
        expected = np.array([turned(ring, exact[1 : len(own), i], speed * time[i]) for i in range(len(time))]) * ring.size
        errors.append(np.abs(record.casing - expected).max() / np.abs(expected).max())
        steps.append(problem.grid.time_step)
        assert np.abs(record.samples[:, 0] - exact[0]).max() < 30.0 * errors[-1] * np.abs(exact[0]).max()
    orders = np.diff(np.log(errors)) / np.diff(np.log(steps))
    assert errors[0] < 3e-2
    assert np.all((orders > 1.9) & (orders < 2.1)), (orders, errors)


@pytest.mark.parametrize("radius", [0.1, 0.251, 0.51, 255.0])
def test_a_ring_far_from_the_tip_is_refused(radius):
    scene = ELASTIC_SCENES["direct"]
    near, far = (replace(scene, casing=replace(scene.casing, ring_radius=one)) for one in (0.255, radius))
    Problem(random_blade(), 3000.0, near, CHOICE)
    with pytest.raises(NoRoomError, match=rf"casing\.ring\.radius_m .*found {radius:g} m round a tip at 0\.252 m; allowed"):
        Problem(random_blade(), 3000.0, far, CHOICE)


def test_exact_gap_and_for_central_differences_a_fast_casing_are_refused():
    with pytest.raises(ValueError, match="an elastic casing needs the linear gap"):
        Problem(random_model(8), 3000.0, replace(ELASTIC_SCENES["direct"], exact_gap=True), CHOICE)
    scene = with_ring(ABRADABLE, [RingMode(2, 2.5e7, 1.0, 0.0)])
    message = r"stability limit of this casing, .*highest mode 3978.*leave its highest modes out"
    with pytest.raises(UnstableStepError, match=message):
        Problem(random_model(8), 3000.0, scene, replace(CHOICE, integrator=CENTRAL_DIFFERENCE))


@pytest.fixture(scope="module")
def waves(tmp_path_factory):
    """casing.nc of one scene with an elastic casing, whose second speed diverges, and one without."""
    folder, responses = tmp_path_factory.mktemp("casing"), {}
    # faster than the rotor with all its nodal diameters, for what that overtakes may grow without bound
    fast = replace(STEEL, radial_foundation=2e9).modes()
    for name, scene in (("elastic", with_ring(ABRADABLE, fast)), ("rigid", ABRADABLE)):
        files = []
        for speed, limit in ((3000.0, 0.1), (3300.0, 1e-9)):
            chosen = replace(scene, divergence_limit=limit)
            results = ["spectrum", *(["casing"] if scene.casing.ring else [])]
            # ends before its statistic is full where it diverges
            choice = replace(CHOICE, revolutions=4, until_settled=True)
            run = run_speed(random_blade(), speed, chosen, choice, results, spectrum_highest_order=20, wear_angles=8)
            files.append(folder / f"{name}_{speed:g}.npz")
            write_speed(run, files[-1], {})
        responses["Ref", name] = folder / f"{name}.nc"
        of_stress = {"stress_history_speeds": (), "yield_stress": 1.0}
        write_response(files, (3000.0, 3300.0), responses["Ref", name], **of_stress, provenance={"numerics": "one"})
    write_sweep_dataset("casing", responses, folder / "casing.nc", {})
    with xr.open_dataset(folder / "casing.nc") as dataset:
        return dataset.load()


def test_waves_of_all_scenes_are_in_one_dataset(waves):
    elastic = waves.sel(blade="Ref", scene="elastic")
    assert waves["casing_amplitude"].dims == ("blade", "scene", "speed", "casing_mode", "casing_order")
    assert waves["casing_energy"].attrs["units"] == "J" and waves["casing_frequency"].attrs["units"] == "Hz"
    np.testing.assert_array_equal(elastic["casing_nodal_diameter"], [mode.nodal_diameter for mode in STEEL.modes()])
    orders = waves["casing_order"].values
    # eleven nodal diameters beyond the blade's orders, as far as the samples tell
    np.testing.assert_array_equal(orders, np.arange(-62, 62) / 2.0)
    assert np.isnan(waves["casing_energy"].sel(scene="rigid")).all()
    first, second = (elastic.sel(speed=speed) for speed in (3000.0, 3300.0))
    assert first["casing_energy"].min() > 0.0 and np.isnan(second["casing_energy"]).all()
    assert int(second["status"]) == 1
    # of what the spectrum keeps, which is nearly all
    kept = np.sqrt(0.5 * (first["casing_amplitude"].sel(casing_order=slice(0.5, None)) ** 2).sum("casing_order"))
    slow = (first["casing_frequency"] < 31 * 3000.0 / 2.0 / np.pi) & (first["casing_nodal_diameter"] > 0)
    np.testing.assert_allclose(kept[slow], first["casing_rms_forward"][slow], rtol=0.1)


def test_waves_are_drawn(waves):
    elastic = waves.sel(blade="Ref", scene="elastic")
    figure = draw_casing_map(elastic, "Ref, elastic")
    titles = [axes.get_title() for axes in figure.axes]
    assert titles[:2] == ["forward: with the rotor", "backward: against the rotor"]
    # one mode at one speed has an extent, too; nodal diameters without a mode stay empty
    single = elastic.isel(speed=[0], casing_mode=[5])
    left, right, low, high = draw_casing_map(single, "Ref").axes[0].images[0].get_extent()
    assert right - left == 1.0 and high - low == 1.0
    gap = draw_casing_map(elastic.isel(speed=[0], casing_mode=[4, 7]), "Ref")
    assert list(np.ma.getmaskarray(gap.axes[0].images[0].get_array()).ravel()) == [False, True, True, False]
    still = draw_casing_map(elastic.isel(speed=[1]), "Ref")
    assert "every run diverged" in [text.get_text() for text in still.axes[0].texts]


@pytest.mark.parametrize(
    ("diameters", "breathing", "untold"), [(30, 31000.0, [False, False, False]), (31, 32000.0, [False, True, True])]
)
def test_a_mode_too_fast_for_the_samples_is_not_told(diameters, breathing, untold):
    modes = (RingMode(2, 1000.0, 1.0, 0.0), RingMode(diameters, 1000.0, 1.0, 0.0), RingMode(0, breathing, 1.0, 0.0))
    found = casing_waves(np.ones((124, 6)), RingMotion(modes), 1000.0, 2, 20)
    for name in ("casing_rms_forward", "casing_rms_backward", "casing_energy"):
        assert list(np.isnan(found[name])) == untold


def straight_campbell():
    """Named modes of frequencies that no speed changes."""
    speed = np.linspace(0.0, 2000.0, 21)
    frequency = np.repeat([[1000.0], [1500.0], [3000.0]], 21, axis=1)[None]
    return xr.Dataset(
        {"frequency": (("blade", "mode", "speed"), frequency)},
        coords={"blade": ["Ref"], "mode": ["1B", "1T", "2B"], "speed": speed},
    )


def test_coincidences_of_straight_lines():
    modes = (RingMode(0, 2.0 * np.pi * 1500.0, 1.0, 0.0), RingMode(6, 2.0 * np.pi * 800.0, 1.0, 0.0))
    table = coincidence_table(straight_campbell(), {"elastic": ElasticCasing(modes)})
    found = {(row.mode, row.wave): row.speed_rad_s for row in table.itertuples() if row.nodal_diameter == 6}
    hertz = 2.0 * np.pi / 6.0
    assert found == {
        ("1B", "backward"): pytest.approx(200.0 * hertz),
        ("1T", "backward"): pytest.approx(700.0 * hertz),
        # the rotor overtakes them
        ("1B", "forward"): pytest.approx(1800.0 * hertz),
    }
    assert list(table["speed_rad_s"]) == sorted(table["speed_rad_s"])
    np.testing.assert_allclose(table["frequency_hz"], [{"1B": 1000.0, "1T": 1500.0}[mode] for mode in table["mode"]])
    assert set(table["simulated"]) == {"yes"}


def test_coincidences_do_not_end_where_the_modes_of_simulations_do():
    """Those of twenty modes are told apart from the others, which are those of a simulation with many more."""
    few, many = (coincidence_table(straight_campbell(), {"elastic": casing_of(FLANGED, n)}) for n in (20, 400))
    assert few.drop(columns="simulated").equals(many.drop(columns="simulated"))
    assert set(many["simulated"]) == {"yes"}
    assert list(few["simulated"]) == ["yes" if n <= 20 else "no" for n in few["nodal_diameter"]]
    hidden = few[few["simulated"] == "no"]
    assert len(hidden) > 10 and hidden["speed_rad_s"].between(0.0, 2000.0).all()


def test_campbell_diagram_shows_each_casing_once():
    campbell = straight_campbell().isel(blade=0)
    campbell = campbell.assign(
        crossing_speed=(("mode", "engine_order"), np.full((3, 1), 900.0)),
        dynamic_clearance=(("mode", "tangential_displacement"), np.zeros((3, 2))),
    ).assign_coords(engine_order=[4], tangential_displacement=[-1e-3, 1e-3])
    six, seven = (to_plain(ElasticCasing((RingMode(n, 2.0 * np.pi * 800.0, 1.0, 0.0),))) for n in (6, 7))

    def drawn(**casings):
        """Labels of the legend, number of lines, and opacity of the diamonds."""
        (axes, *_) = draw_campbell(campbell, "Ref", casings).axes
        diamonds = [line.get_alpha() for line in axes.lines if line.get_marker() == "D"]
        return set(axes.get_legend_handles_labels()[1]), len(axes.lines), diamonds

    labels, lines, diamonds = drawn(a=six)
    assert {"casing, forward", "casing, backward"} <= labels and len(diamonds) == 3
    assert drawn(a=six, b=six)[1] == lines
    assert {"casing of a, forward", "casing of b, backward"} <= drawn(a=six, b=seven)[0]
    labels, _, diamonds = drawn(a=to_plain(casing_of(FLANGED, 20)))
    assert {"casing, forward", "casing, not simulated"} <= labels and set(diamonds) == {0.4, 1.0}


RING = {"radius_m": 0.255, "thickness_m": 0.002, "width_m": 0.05, "elastic_modulus_pa": 2.1e11, "density_kg_m3": 7850}


@pytest.mark.parametrize("speed", [1800.0, 1820.0])
def test_a_run_above_a_critical_speed_says_so(root, speed):
    """That of the shipped ring is 1809 rad/s."""
    changes = {"scenes": ["elastic_abradable", "abradable"], "speeds": [speed]}
    remarks = [one for one in remarks_of_pipeline(read_settings(root, command_line_document(changes))) if "overtakes" in one]
    begins = f"scene elastic_abradable: speeds up to {speed:g} rad/s; above 1809 the rotor overtakes waves of the casing, which"
    assert remarks == ([f"{begins} may then grow without bound"] if speed > 1809.0 else [])


@pytest.mark.parametrize(
    ("ring", "speed", "refusal"),
    [
        ({}, 2000.0, ""),
        # 95% of the flexibility, whichever speeds are run
        ({"highest_nodal_diameter": 51}, 1000.0, ""),
        ({"highest_nodal_diameter": 50}, 1000.0, "found 50 nodal diameters, 9.* of .*; allowed: 51 or more, or leave it out"),
        # soft flanges have it with 17, and those up to 43 are overtaken
        ({"radial_foundation_n_m2": 1e7, "tangential_foundation_n_m2": 1e7, "highest_nodal_diameter": 43}, 2000.0, ""),
        (
            {"radial_foundation_n_m2": 1e7, "tangential_foundation_n_m2": 1e7, "highest_nodal_diameter": 42},
            2000.0,
            "43 or more",
        ),
        ({"radial_foundation_n_m2": 1e7, "tangential_foundation_n_m2": 1e7}, 2000.0, ""),
        ({"thickness_m": 1e-4}, 1000.0, "allowed: at most 100, and [0-9]+ are needed .*: a thicker ring, or the ring_modes"),
    ],
)
def test_a_ring_without_waves_that_count_is_refused(root, tmp_path, ring, speed, refusal):
    text = (
        root / "config" / "scenes.yaml"
    ).read_text() + f"\nring: {{ base: elastic_direct, casing: {{ ring: {to_json(ring)} }} }}\n"
    (tmp_path / "scenes.yaml").write_text(text)
    changes = {"scenes": ["ring"], "speeds": [speed], "scenes_file": str(tmp_path / "scenes.yaml")}
    if not refusal:
        read_settings(root, command_line_document(changes))
        return
    with pytest.raises(ConfigError, match=refusal):
        read_settings(root, command_line_document(changes))


def test_all_modes_of_given_ones_are_simulated():
    modes = (RingMode(0, 900.0, 1.0, 0.0), RingMode(4, 2000.0, 1.0, 0.0))
    casing = ElasticCasing(modes)
    assert casing.modes_met(1e6, 1e6) == modes
    assert casing.critical_speed == 500.0 and critical_speed(modes[:1]) == np.inf
    assert not [*remarks_on_overtaken_waves("scene", casing, 500.0)]
    assert next(remarks_on_overtaken_waves("scene", casing, 501.0)).endswith("grow without bound")


RINGS = [
    replace(FLANGED, thickness=thickness, radial_foundation=radial, tangential_foundation=tangential)
    for thickness in (4e-3, 1e-3)
    for radial, tangential in ((1e9, 1e9), (1e9, 0.0), (0.0, 1e6), (0.0, 0.0), (1.0, 1e13), (1e-3, 1e3))
]


@pytest.mark.parametrize("ring", RINGS)
def test_the_slowest_wave_is_that_of_all(ring):
    modes = [mode for mode in casing_of(ring, 1000).modes if mode.nodal_diameter]
    slowest = min(modes, key=lambda mode: mode.frequency / mode.nodal_diameter)
    number, speed = slowest_wave(ring)
    assert number == slowest.nodal_diameter
    assert speed == pytest.approx(slowest.frequency / number) == pytest.approx(casing_of(ring, 2).critical_speed)


@pytest.mark.parametrize("ring", RINGS)
@pytest.mark.parametrize(("speed", "frequency"), [(0.0, 0.0), (2000.0, 0.0), (2000.0, 2e4), (50.0, 2e4)])
def test_no_shorter_wave_is_met(ring, speed, frequency):
    met = [
        mode.nodal_diameter
        for mode in casing_of(ring, 1000).modes
        if mode.nodal_diameter and mode.frequency - mode.nodal_diameter * speed <= frequency
    ]
    bound = shortest_met(ring, speed, frequency)
    assert slowest_wave(ring)[0] <= shortest_met(ring, slowest_wave(ring)[1])
    assert max(met, default=0) <= bound
    # and not many more are looked at than there are
    if speed >= 2000.0 and ring.radial_foundation == 0.0:
        assert bound <= max(met, default=0) + 2


@pytest.mark.parametrize("ring", RINGS)
def test_the_flexibility_of_all_modes_is_the_limit_of_their_sum(ring):
    assert flexibility(ring) == pytest.approx(flexibility_of(casing_of(ring, 4000).modes), rel=1e-6)
    assert flexibility(ring) > flexibility_of(casing_of(ring, 20).modes)
    number = nodal_diameters_for(ring, 0.0, 0.5)
    assert flexibility_of(casing_of(ring, number).modes) >= 0.5 * flexibility(ring)
    assert number < 3 or flexibility_of(casing_of(ring, number - 1).modes) < 0.5 * flexibility(ring)


def test_the_lowest_critical_speed_is_that_of_a_beam_on_a_foundation():
    ring = replace(STEEL, radial_foundation=1e8, tangential_foundation=0.0, highest_nodal_diameter=100)
    bending, mass = ring.elastic_modulus * ring.width * ring.thickness**3 / 12.0, ring.density * ring.width * ring.thickness
    expected = (4.0 * 1e8 * bending / mass**2) ** 0.25 / ring.radius
    assert critical_speed(ring.modes()) == pytest.approx(expected, rel=5e-3)


def test_a_ring_of_the_configuration():
    free = checked_scene({"casing": {"clearance_m": 3e-4, "ring": RING}}).casing.ring
    assert [mode.nodal_diameter for mode in free] == [0, *range(2, 47)]
    assert checked_scene({"casing": {"clearance_m": 3e-4, "ring": RING}}).casing.ring_radius == 0.255
    held = RING | {
        "radial_foundation_n_m2": 1e7,
        "tangential_foundation_n_m2": 1e6,
        "highest_nodal_diameter": 11,
        "damping_ratio": 0.002,
    }
    assert checked_scene({"casing": {"clearance_m": 3e-4, "ring": held}}).casing.ring == STEEL.modes()
    table = [
        {"nodal_diameter": 3, "frequency_hz": 500, "modal_mass_kg": 0.7},
        {"nodal_diameter": 0, "frequency_hz": 900, "modal_mass_kg": 1.5, "damping_ratio": 0.01},
        {"nodal_diameter": 4, "frequency_hz": 600, "modal_mass_kg": 0.6, "tangential_ratio": 0.1},
    ]
    modes = checked_scene({"casing": {"clearance_m": 3e-4, "ring_modes": table}}).casing.ring
    assert modes[0] == RingMode(3, 1000.0 * np.pi, 0.7, 0.005, 1.0, 1.0 / 3.0)
    assert [mode.tangential for mode in modes[1:]] == [0.0, 0.1]


def test_a_rotor_at_rest_is_no_coincidence():
    """Where the blade has the very frequency of the casing; the speed at which they meet again is one."""
    mode, speeds = RingMode(3, 2.0 * np.pi * 800.0, 1.0), np.linspace(0.0, 2000.0, 9)
    for wave in waves_of(mode):
        of_wave = seen_from_rotor(mode, wave, speeds)
        blade = of_wave + 1e-4 * speeds * (speeds - 1000.0)
        assert blade[0] == of_wave[0]
        frequency = xr.DataArray(blade, {"speed": speeds}, "speed")
        speeds_met = [speed for speed, _ in coincidences(frequency, mode, wave)]
        assert min(speeds_met) > 1.0 and any(abs(speed - 1000.0) < 1e-6 for speed in speeds_met)
