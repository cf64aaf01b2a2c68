"""Stress: its recovery, the largest of each revolution and of a run's together, its regions; the reduction of the sweep."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from box_mesh import box_mesh
from box_operator import box_operator
from defaults import Casing, Friction, IntegrationChoice, Lining, Scene
from integration_cases import DIRECT

from r37core.base.dataset_file import attributes_of, joined_hash, read_dataset, write_dataset
from r37core.base.io import InputFileError, Named
from r37core.base.variable import Variable
from r37core.fem.elements import ELEMENTS
from r37core.fem.material import Material
from r37core.fem.stress import COMPONENTS, interpolated, recovered_stress, stress_at
from r37core.results.datasets import response_of, write_sweep_dataset
from r37core.results.interaction_choice import InteractionChoice
from r37core.results.interactions import find_interactions
from r37core.results.ranking import length_sustained, robustness
from r37core.results.regions import judged, other_regions, read_judged
from r37core.results.response import write_response
from r37core.results.steps import ranking
from r37core.rom import stress_region
from r37core.rom.recovery_nodes import RecoveryNodes
from r37core.rom.reduced_model import contact_model
from r37core.rom.region_choice import RegionChoice
from r37core.rom.rom_file import read_reduced_model, write_reduced_model
from r37core.rom.stress_region import StressRegion
from r37core.stress.operator import StressOperator, read_stress_operators, von_mises, write_stress_operators
from r37core.stress.recovery import stress_operator, stress_operators
from r37core.stress.revolutions import largest_of_revolutions
from r37core.stress.statistic import stress_statistic
from r37core.time_integration.simulate import DIRECTIONS, Simulation
from r37core.time_integration.speed_arrays import PLACE_OF_STRESS, STATUS
from r37core.time_integration.speed_file import read_speed, write_speed
from r37core.time_integration.speed_run import numbers_of_run, run_speed

INSTANTS, REVOLUTIONS = 31, 40

LAST = "max_von_mises_last_revolution"


@pytest.fixture
def stress(model, steel):
    return box_operator(model, steel)


def motion(model):
    """Random motion of ten modes, the slower the larger, and the modes as shapes of the reduced coordinates."""
    frequencies, shapes = model.modes(0.0, 10)
    random = np.random.default_rng(0)
    return random.standard_normal((REVOLUTIONS * INSTANTS, 10)) * 1e-3 * frequencies[0] / frequencies, shapes


def in_full(stress, coordinates):
    return stress.max_von_mises(coordinates).reshape(REVOLUTIONS, INSTANTS).max(axis=1)


def test_the_largest_stress_of_each_revolution_is_that_of_all_nodes_and_instants(model, stress):
    states, shapes = motion(model)
    wanted = in_full(stress, states @ shapes.T)
    found, _ = largest_of_revolutions(stress, states, shapes, np.empty(0), INSTANTS)
    np.testing.assert_allclose(found, wanted, rtol=2e-6)


def test_rotation_s_stress_is_in_it(model, stress):
    states, shapes = motion(model)
    rotation = np.full(model.stress_regions["box"].nodes.rotation_shapes.shape[2], 2e6)
    both = np.hstack([states @ shapes.T, np.broadcast_to(rotation, (len(states), len(rotation)))])
    assert stress.have_rotation(both) and not stress.have_rotation(states @ shapes.T)
    found, _ = largest_of_revolutions(stress, states, shapes, rotation, INSTANTS)
    np.testing.assert_allclose(found, in_full(stress, both), rtol=2e-6)
    assert np.all(found != largest_of_revolutions(stress, states, shapes, np.empty(0), INSTANTS)[0])


@pytest.mark.parametrize(("numbers", "at_its_worst"), [(2, (1.5, 2.0)), (2, (0.1, 2.0)), (20, (1.5, 2.0))])
def test_a_node_that_is_the_worst_in_one_revolution_alone_is_found(numbers, at_its_worst):
    """Node 1 answers the second number alone, which moves in one instant; the last revolution does not know of it.

    Of few numbers it is found where all other nodes rest meanwhile.
    """
    operator = np.zeros((6, 2, numbers))
    operator[0, 0, 0], operator[3, 1, 1] = 1.0, 1.0
    states = np.zeros((3 * 3, numbers))
    states[:, 0], states[4, :2] = 1.0, at_its_worst
    found, nodes = largest_of_revolutions(StressOperator(operator, numbers, ""), states, np.eye(numbers), np.empty(0), 3)
    assert nodes.tolist() == [0, 1, 0]
    np.testing.assert_allclose(found, [1.0, np.sqrt(3.0) * 2.0, 1.0], rtol=1e-6)


def test_few_numbers_miss_no_node_nor_instant():
    """Of 70 revolutions, more than are looked at together, with and without a steady stress."""
    random = np.random.default_rng(1)
    operator, states = random.standard_normal((6, 40, 6)), random.standard_normal((70 * INSTANTS, 4))
    stress = StressOperator(operator, 4, "")
    for rotation in (np.empty(0), np.array([0.5, -2.0])):
        coordinates = np.hstack([states, np.broadcast_to(rotation, (len(states), len(rotation)))])
        every = stress.von_mises(coordinates).reshape(70, INSTANTS, 40)
        found, nodes = largest_of_revolutions(stress, states, np.eye(4), rotation, INSTANTS)
        np.testing.assert_allclose(found, every.max(axis=(1, 2)), rtol=2e-6)
        np.testing.assert_array_equal(nodes, every.max(axis=1).argmax(axis=1))


def test_a_region_without_elements_is_refused_before_any_simulation(model, steel):
    """Each simulation reads this operator, so that its job comes before theirs."""
    empty = replace(model.stress_regions["box"], elements={}, description="x < 0.15 m")
    with pytest.raises(ValueError, match=r"the stress region first \(x < 0\.15 m\) has no elements; enlarge it in structure\."):
        stress_operators(replace(model, stress_regions={"first": empty, **model.stress_regions}), steel)
    # of another one nothing is known
    others = stress_operators(replace(model, stress_regions=model.stress_regions | {"box": empty}), steel)
    assert list(others) == ["airfoil", "airfoil_unfiltered"]


def test_the_operators_survive_their_file(model, steel, tmp_path):
    operators = stress_operators(model, steel)
    write_stress_operators(operators, tmp_path / "stress.npz")
    again = read_stress_operators(tmp_path / "stress.npz")
    assert list(again) == list(operators)
    for name, operator in operators.items():
        for field, value in vars(operator).items():
            np.testing.assert_array_equal(getattr(again[name], field), value)


def test_the_statistic_of_known_revolutions():
    found = stress_statistic(np.arange(1.0, 12.0), 9.0)
    assert found == {
        "max_von_mises_median": 6.0, "max_von_mises_high": 10.0,
        "share_of_revolutions_above_yield": pytest.approx(2 / 11),
    }  # fmt: skip
    assert all(np.isnan(value) for value in stress_statistic(np.array([1.0, np.nan]), 9.0).values())
    assert stress_statistic(np.ones(3), np.inf)["share_of_revolutions_above_yield"] == 0.0


MATERIAL = Material(180e9, 8000.0, 0.3, 1.38e9)


def box_model(*fields):
    """A stand-in for a reduced model: a box whose reduced coordinates are given displacement fields."""
    mesh = box_mesh(1.0, 0.5, 0.2, (3, 2, 1))
    basis = np.stack([field(mesh.points) for field in fields], axis=2)
    nodes = RecoveryNodes(np.arange(len(mesh.points)), mesh.points, basis, np.zeros((len(mesh.points), 3, 1)))
    every = np.arange(len(mesh.points))
    region = StressRegion("box", np.inf, nodes, dict(mesh.blocks), every, mesh.parameters, False)
    return SimpleNamespace(stress_regions={"box": region}, size=len(fields), logarithmic_stiffness=None)


def test_stress_of_simple_states():
    """Von Mises: tension E times strain, shear sqrt(3) times the shear stress, bending E times curvature times height."""

    def tension(p):
        return 1e-3 * p * np.array([1.0, -0.3, -0.3])

    def shear(p):
        return 1e-3 * np.stack([p[:, 1], 0 * p[:, 0], 0 * p[:, 0]], axis=1)

    def bending(p):
        # pure bending about y: stress E kappa z along x
        x, y, z = p.T
        kappa, nu = 1e-2, 0.3
        return kappa * np.stack([x * z, -nu * y * z, -0.5 * (x**2 + nu * (z**2 - y**2))], axis=1)

    recovery = stress_operator(box_model(tension, shear, bending), MATERIAL)
    levels = recovery.max_von_mises(np.eye(3))
    assert levels[0] == pytest.approx(180e6, rel=1e-9)
    assert levels[1] == pytest.approx(np.sqrt(3.0) * 180e9 / 2.6 * 1e-3, rel=1e-9)
    assert levels[2] == pytest.approx(180e9 * 1e-2 * 0.2, rel=1e-9)
    assert recovery.max_von_mises(np.array([[-2.0, 0.0, 0.0]]))[0] == pytest.approx(360e6)


def test_stress_at_integration_points():
    """Bending: Young's modulus times curvature times height, largest at the outer of three Gauss points through one layer."""
    box = box_model(lambda p: np.stack([1e-2 * p[:, 0] * p[:, 2], 0 * p[:, 0], -0.5e-2 * p[:, 0] ** 2], axis=1))
    region = box.stress_regions["box"]
    count = 9 * len(region.elements["wedge15"])
    region = replace(region, evaluated=np.arange(count), integration_points=True)
    operator = stress_operator(
        SimpleNamespace(**vars(box) | {"stress_regions": {"box": region}}), replace(MATERIAL, poissons_ratio=0.0)
    )
    np.testing.assert_allclose(operator.operator[0, :, 0], 180e7 * region.points[:, 2], rtol=1e-9)
    assert region.points[:, 2].max() == pytest.approx(0.1 * (1.0 + np.sqrt(0.6)))
    assert len(np.unique(region.points.round(9), axis=0)) == count


def test_the_order_of_the_types_counts_for_nothing():
    """A file may have an imported mesh's types in another order than the mesh."""
    mesh = box_mesh(1.0, 0.5, 0.2, (2, 1, 1), element=lambda i, j, k: ("wedge15", "hexahedron20")[i])
    turned = dict(reversed(mesh.blocks.items()))
    assert list(turned) != list(mesh.blocks)
    fields = mesh.points[:, [1, 2, 0], None] ** 2
    for of in (
        lambda b: interpolated(b, mesh.points, True),
        lambda b: recovered_stress(b, mesh.points, fields, MATERIAL, True),
    ):
        np.testing.assert_array_equal(of(turned), of(mesh.blocks))


def test_a_region_at_integration_points(model, mesh, steel, reduced, tmp_path, monkeypatch):
    """Its candidates have the stress, computed element by element, and the largest of the first mode in the benchmark's box."""
    choice = RegionChoice(maximum_x=0.197, minimum_z=0.0165, maximum_z=0.0265, integration_points=True)
    monkeypatch.setattr(stress_region, "_MOST_POINTS", 20)
    made = reduced(regions={"box": choice}, recover_whole_blade=True)
    write_reduced_model(made, tmp_path / "rom.nc")
    shape = made.modes(0.0, 1)[1]
    operator = stress_operator(read_reduced_model(tmp_path / "rom.nc"), steel)
    assert "at integration points" in operator.region
    elements = choice.elements(mesh, np.empty(0, int))["wedge15"]
    gradients, _ = ELEMENTS["wedge15"].physical_gradients(mesh.points[elements], ELEMENTS["wedge15"].stiffness_rule[0])
    tensors = stress_at(gradients, (made.whole_blade.basis @ shape)[elements, :, 0], steel)
    wanted = von_mises(np.array([tensors[..., a, b] for a, b in COMPONENTS]))
    found = operator.von_mises(shape.T)[0]
    assert found.max() == pytest.approx(wanted.max(), rel=1e-9)
    nearest = np.abs(found[:, None] - wanted.ravel()).min(axis=1)
    assert nearest.max() < 1e-9 * found.max() and len(found) < wanted.size
    at_nodes = stress_operators(model, steel)["box"].max_von_mises(model.modes(0.0, 1)[1].T)
    assert 1.15 < at_nodes / found.max() < 1.4


def test_a_node_has_the_mean_stress_of_its_elements():
    """Tension on one side of a plane between elements: on it, the stress is shared by how many elements are on either side."""
    box = box_model(lambda p: 1e-3 * np.maximum(p - [1.0 / 3.0, 0.0, 0.0], 0.0) * [1.0, 0.0, 0.0])
    along = stress_operator(box, Material(180e9, 8000.0, 0.0, 1.38e9)).operator[0, :, 0]
    elements, points = box.stress_regions["box"].elements["wedge15"], box.stress_regions["box"].nodes.points
    strained = points[elements].mean(axis=1)[:, 0] > 1.0 / 3.0
    means = set()
    for node, stress in enumerate(along):
        share = strained[np.any(elements == node, axis=1)].mean()
        assert stress == pytest.approx(180e6 * share, abs=1.0)
        means.add(round(share, 3))
    assert means - {0.0, 1.0}


def respond(sources, speeds, file, history=(), yield_stress=1.0, **provenance):
    write_response(sources, speeds, file, stress_history_speeds=history, yield_stress=yield_stress, provenance=provenance)
    return file


SPEEDS = (900.0, 1200.0, 1600.0)
RESULTS = ("spectrum", "stress", "wear", "energy")


@pytest.fixture(scope="module")
def sweep(model, tmp_path_factory):
    """Two scenes at three speeds of the coarse reference blade; the direct one diverges at the last speed."""
    folder = tmp_path_factory.mktemp("sweep")
    contact = contact_model(model, "pressure_edge")
    casing = Casing(0.356e-3, rise_fraction=0.5)
    abradable = Scene(casing, Lining(5e-3, 20e9, 5e9, 1.5, bar_width=0.03), Friction(0.15))
    recovery = {"box": box_operator(model, MATERIAL)}
    files = {}
    for name, lined in (("abradable", abradable), ("direct", Scene(casing, None, Friction(0.15)))):
        sources, speeds = [], SPEEDS if lined.lining else SPEEDS[1:]
        for speed in speeds:
            limit = 1e-7 if name == "direct" and speed == SPEEDS[-1] else 0.05
            scene = Scene(lined.casing, lined.lining, lined.friction, divergence_limit=limit)
            history = 4 if speed == 1200.0 else 2
            choice = IntegrationChoice(2e-7, 4, 62, snapshots_per_revolution=31, snapshot_revolutions=history)
            wanted = [kind for kind in RESULTS if kind != "wear" or lined.lining]
            kept = run_speed(contact, speed, scene, choice, wanted, spectrum_highest_order=10, wear_angles=60, stress=recovery)
            sources.append(folder / f"{name}_{speed:g}.npz")
            write_speed(kept, sources[-1], {})
        files["Ref", name] = respond(sources, speeds, folder / f"{name}.nc", (1200.0,), blade="Ref", scene=name)
    return folder, files


def test_response_holds_every_speed(sweep):
    _, files = sweep
    with xr.open_dataset(files["Ref", "abradable"]) as response:
        np.testing.assert_array_equal(response["speed"], SPEEDS)
        assert response["wear"].shape == (3, 60) and np.all(response["status"] == 0)
        assert np.all(response[LAST] > 0.0)
        assert response["stress_region"].item() == "x < 0.197 m, z > 0.0165 m, z < 0.0265 m"
        history = response["max_von_mises_history"].sel(history_speed=1200.0)
        history = history.squeeze("region")
        assert history[-1] == pytest.approx(float(response[LAST].sel(speed=1200.0).squeeze()), rel=1e-6)
        first = int(np.flatnonzero(history.values > 1.0)[0]) + 1
        assert response["first_yield_revolution"].sel(speed=1200.0) == first
        for name, variable in response.variables.items():
            assert name in ("tip_point", "region") or {"units", "long_name"} <= set(variable.attrs), name
    with xr.open_dataset(files["Ref", "direct"]) as response:
        assert "wear" not in response
        np.testing.assert_array_equal(response["status"], [0, 1])
        assert np.isnan(response["rms_radial"].isel(speed=1)).all()
        assert np.isnan(response[LAST].isel(speed=1)).all()
        assert response["diverged_revolution"].isel(speed=1) > 0.0


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({"rms_norm": np.zeros(2)}, r"rms_norm: found an array that is not declared; declare it in .*\.speed_arrays"),
        ({"rms_normal": np.zeros(2), "peak_normal": np.zeros(3)}, r"peak_normal: .* shape \(3,\); allowed: tip_point \(2\)"),
        ({"lined": np.zeros(1)}, r"lined: found an array of shape \(1,\); allowed: a number"),
    ],
)
def test_only_declared_arrays_are_written(arrays, message, tmp_path):
    with pytest.raises(ValueError, match=message):
        write_speed({"status": np.array(0), **arrays}, tmp_path / "speed_900.npz", {})
    assert not any(tmp_path.iterdir())


def test_only_declared_arrays_are_read(tmp_path):
    file, more = tmp_path / "speed_900.npz", {"rms_normal": Variable((), "m", ""), "costs": Variable((), "s", "")}
    write_speed({"status": np.array(0), "costs": np.array(1.0)}, file, {}, STATUS | more)
    assert list(read_speed(file)) == ["status"] and list(read_speed(file, more)) == ["status", "costs"]
    write_speed({"status": np.array(0), "rms_normal": np.array(1.0)}, file, {}, STATUS | more)
    with pytest.raises(InputFileError, match=r"speed_900\.npz: .* rms_normal: found .* shape \(\); allowed: tip_point"):
        read_speed(file)


def test_response_names_directions_and_tip_points(sweep):
    """Against a run: tip point by direction (normal, tangential)."""
    folder, files = sweep
    with xr.open_dataset(files["Ref", "abradable"]) as response:
        for speed in SPEEDS:
            run = read_speed(folder / f"abradable_{speed:g}.npz")
            at = response.sel(speed=speed)
            for point, tip_point in enumerate(("leading_edge", "trailing_edge")):
                tip = at.sel(tip_point=tip_point)
                for direction in DIRECTIONS:
                    assert tip[f"rms_{direction}"] == run[f"rms_{direction}"][point]
                    assert tip[f"peak_{direction}"] == run[f"peak_{direction}"][point]
                np.testing.assert_array_equal(tip["revolution_maximum"], run["revolution_maximum"][:, point].astype("f4"))
            for name in ("amplitude", "amplitude_tangential"):
                np.testing.assert_array_equal(at[name], run[name])
        assert np.degrees(float(response["casing_cone_angle"])) == pytest.approx(-15.24, abs=0.01)


@pytest.mark.parametrize("kind", ["rms", "spectrum", "stress", "wear"])
def test_datasets_join_blades_and_scenes(sweep, kind):
    folder, files = sweep
    files = {key: file for key, file in files.items() if kind != "wear" or key[1] == "abradable"}
    write_sweep_dataset(kind, files, folder / f"{kind}.nc", {"fidelity": "draft"})
    with xr.open_dataset(folder / f"{kind}.nc") as dataset:
        assert dataset.attrs["fidelity"] == "draft"
        np.testing.assert_array_equal(dataset["speed"], SPEEDS)
        np.testing.assert_allclose(dataset["speed_rpm"], 60.0 * np.array(SPEEDS) / (2.0 * np.pi))
        for (blade, scene), file in files.items():
            with xr.open_dataset(file) as response:
                for name in dataset.data_vars:
                    part = dataset[name].sel(blade=blade, scene=scene)
                    if "speed" in part.dims:
                        part = part.sel(speed=response["speed"])
                    np.testing.assert_array_equal(part, response.get(name, np.nan))
        if kind != "wear":
            np.testing.assert_array_equal(dataset["status"].sel(scene="direct", blade="Ref"), [2, 0, 1])
            assert dataset["status"].attrs["flag_meanings"] == "completed diverged not_run"
        if kind == "rms":
            assert np.isnan(dataset["rms_normal"].sel(scene="direct", blade="Ref", speed=900.0)).all()


def test_a_joined_file_hashes_what_its_parts_say(tmp_path):
    for name, number in (("one", 1), ("other", 2), ("third", 3)):
        attributes = {"input_hash": f"{number}", "scene": name}
        write_dataset(xr.Dataset({"x": ("speed", [number])}), tmp_path / f"{name}.nc", attributes)
    first, second = tmp_path / "one.nc", tmp_path / "other.nc"
    made = joined_hash(attributes_of([first, second]))
    assert made == joined_hash(attributes_of([second, first]))
    assert len({made, joined_hash(attributes_of([first])), joined_hash(attributes_of([first, tmp_path / "third.nc"]))}) == 3
    with pytest.raises(InputFileError, match=r"none\.nc"):
        joined_hash(attributes_of([first, tmp_path / "none.nc"]))


def test_responses_of_two_levels_do_not_mix(sweep, tmp_path):
    source, _ = sweep
    files = {}
    for blade, numerics in (("A", "20000 nodes, exact_modal of 4e-07 s"), ("B", "5000 nodes, exact_modal of 8e-07 s")):
        sources = [source / "abradable_900.npz"]
        files[blade, "abradable"] = respond(sources, (900.0,), tmp_path / f"{blade}.nc", numerics=numerics)
    with pytest.raises(InputFileError, match=r"A\.nc was made with 20000 nodes.*B\.nc with 5000 nodes.*delete the one"):
        write_sweep_dataset("rms", files, tmp_path / "rms.nc", {})
    assert not (tmp_path / "rms.nc").exists()


AIRFOIL = {"minimum_span": 0.05, "maximum_span": 0.9}
KEPT = {"spectrum_highest_order": 5, "wear_angles": 60}
CHOICE = IntegrationChoice(8e-7, 6, 62, integrator="exact_modal", snapshots_per_revolution=31, snapshot_revolutions=6)


@pytest.fixture(scope="module")
def every_node(reduced):
    """The model that looks at all nodes of the airfoil."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stress_region, "_MOST_POINTS", 10**6)
        return reduced()


@pytest.mark.parametrize("speed", [1000.0, 1340.0, 1700.0])
def test_candidates_have_the_largest_stress_of_all_nodes(model, every_node, contact, steel, speed):
    """On this coarse mesh one of a hundred revolutions may differ, by 4% on one kind of processor, as the motion is chaotic."""
    few, all_nodes = (stress_operators(each, steel) for each in (model, every_node))
    assert len(few["airfoil"].places) < 0.15 * len(all_nodes["airfoil"].places)
    choice = replace(CHOICE, revolutions=40, snapshot_revolutions=40)
    run, results = Simulation(contact, speed, DIRECT, choice).run(), ("stress", "static_stress")
    found, wanted = (numbers_of_run(run, results, stress=each, **KEPT)["revolution_von_mises"] for each in (few, all_nodes))
    np.testing.assert_array_equal(found[2], wanted[2])
    ratio = found[:2, -20:] / wanted[:2, -20:]
    assert ratio.max() < 1.0 + 1e-5 and ratio.min() > 0.95
    assert np.median(ratio) == 1.0 and ratio.mean(axis=1).min() > 0.998


def test_the_band_leaves_out_a_mode_above_the_limit(model, steel):
    """A motion in one mode: all of its stress counts below the limit, and none above it."""
    frequencies, modes = model.modes(0.0, 9)
    operators = stress_operators(model, steel)
    assert len(operators["airfoil"].band) == np.count_nonzero(frequencies <= 2.0 * np.pi * 7500.0) == 6
    region = model.stress_regions["airfoil"]
    without_limit = {"all": replace(region, highest_frequency=np.inf)}
    unlimited = stress_operators(replace(model, stress_regions=without_limit), steel)["all"]
    stress, full = operators["airfoil"].max_von_mises(modes.T), unlimited.max_von_mises(modes.T)
    np.testing.assert_allclose(stress[:6], full[:6], rtol=1e-9)
    assert stress[6:].max() < 1e-9 * full[6:].min()
    states = 1e-4 * np.random.default_rng(0).standard_normal((62, 9))
    found, nodes = largest_of_revolutions(operators["airfoil"], states, modes, np.empty(0), 31)
    slow = unlimited.von_mises(states[:, :6] @ modes[:, :6].T).reshape(2, 31, -1).max(axis=1)
    np.testing.assert_allclose(found, slow.max(axis=1), rtol=1e-5)
    assert nodes.tolist() == slow.argmax(axis=1).tolist()


def test_a_limit_below_all_modes_is_refused(model, steel):
    low = {"low": replace(model.stress_regions["airfoil"], highest_frequency=10.0)}
    with pytest.raises(
        ValueError, match=r"^stress_regions: found highest_frequency_hz 10 .*; allowed: more than the first mode's, 8\d\d"
    ):
        stress_operators(replace(model, stress_regions=low), steel)


def test_spans_and_descriptions(mesh):
    choice = RegionChoice(**AIRFOIL, highest_frequency=7500.0)
    nodes = np.unique(np.concatenate([block.ravel() for block in choice.elements(mesh, np.empty(0, int)).values()]))
    span = mesh.parameters[nodes, 1]
    assert 0.05 <= span.min() < 0.12 and 0.8 < span.max() <= 0.9
    assert choice.description() == "5 to 90% span, modes up to 7500 Hz"
    assert RegionChoice().description() == "whole blade"


def test_places_are_those_of_the_nodes(contact, model, mesh, steel):
    operators = stress_operators(model, steel)
    for name, region in model.stress_regions.items():
        np.testing.assert_array_equal(operators[name].places, mesh.parameters[region.nodes.nodes[region.evaluated]])
    kept = run_speed(contact, 1340.0, DIRECT, CHOICE, ("stress",), stress=operators, **KEPT)
    places = np.stack([kept[name] for name in PLACE_OF_STRESS], axis=1)
    for name, place in zip(operators, places, strict=True):
        assert (operators[name].places == place).all(axis=1).any()
    assert kept["max_von_mises_span"][0] > kept["max_von_mises_span"][2]
    diverged = run_speed(contact, 1340.0, replace(DIRECT, divergence_limit=2e-4), CHOICE, ("stress",), stress=operators, **KEPT)
    assert all(np.isnan(diverged[name]).all() for name in PLACE_OF_STRESS)


THREE_SPEEDS = [1000.0, 1340.0, 1700.0]


@pytest.fixture(scope="module")
def responses(contact, model, steel, tmp_path_factory):
    """Two blades; the box of one of them has no elements."""
    folder, made = tmp_path_factory.mktemp("regions"), {}
    operators = stress_operators(model, steel)
    of_odd = {name: operators[name] for name in ("airfoil", "airfoil_unfiltered")}
    for blade, stress in {"Ref": operators, "Odd": of_odd}.items():
        files = [folder / f"{blade}_{speed:g}.npz" for speed in THREE_SPEEDS]
        for speed, file in zip(THREE_SPEEDS, files, strict=True):
            write_speed(run_speed(contact, speed, DIRECT, CHOICE, ("stress",), stress=stress, **KEPT), file, {})
        acts_on = "points" if blade == "Ref" else "patches"
        made[blade, "direct"] = respond(files, THREE_SPEEDS, folder / f"{blade}.nc", yield_stress=3e8, contact=acts_on)
    return made


@pytest.fixture(scope="module")
def datasets(responses, tmp_path_factory):
    folder, made = tmp_path_factory.mktemp("datasets"), {}
    for kind in ("rms", "stress"):
        # the blade without a box first: regions keep their order
        write_sweep_dataset(kind, dict(reversed(responses.items())), folder / f"{kind}.nc", {})
        made[kind] = read_dataset(folder / f"{kind}.nc")
    return made


def test_the_first_region_is_judged(responses, datasets):
    whole = read_dataset(responses["Ref", "direct"])
    assert whole["max_von_mises_median"].dims == ("speed", "region") and whole["region"].values[0] == "airfoil"
    alone = read_judged(responses["Ref", "direct"])
    assert "region" not in alone.variables
    assert alone["stress_region"].item() == "5 to 90% span, modes up to 7500 Hz"
    np.testing.assert_array_equal(alone[LAST], whole[LAST].sel(region="airfoil"))
    assert judged(alone) is alone
    np.testing.assert_array_equal(response_of(datasets, "Ref", "direct")[LAST], alone[LAST])
    box = response_of(datasets, "Ref", "direct", "box")[LAST]
    np.testing.assert_array_equal(box, whole[LAST].sel(region="box"))


def test_a_blade_without_a_region_has_nothing_there(datasets):
    stress = datasets["stress"]
    assert stress.attrs["contact"] == "patches: Odd; points: Ref"
    assert stress["region"].values.tolist() == ["airfoil", "airfoil_unfiltered", "box"]
    odd = stress.sel(blade="Odd", scene="direct", region="box")
    assert odd["max_von_mises_median"].isnull().all() and odd["stress_region"].item() == ""
    assert other_regions(stress) == ["airfoil_unfiltered", "box"] and other_regions(judged(stress)) == []
    assert np.isnan(length_sustained(response_of(datasets, "Odd", "direct", "box")))


def test_the_ranking_has_a_length_in_each_other_region(datasets, tmp_path):
    for kind, dataset in datasets.items():
        dataset.to_netcdf(tmp_path / f"{kind}.nc")
    table, pairs = tmp_path / "ranking.csv", [("Ref", "direct"), ("Odd", "direct")]
    given = Named(**{kind: tmp_path / f"{kind}.nc" for kind in datasets})
    params = {
        "runs": pairs,
        "errors": [0.0, 0.0],
        "operating": None,
        "contacts": dict.fromkeys(("Ref", "Odd"), ""),
        "added": {},
    }
    ranking(given, Named(table=table), Named(**params))
    table = pd.read_csv(table).set_index("blade")
    for region in ("airfoil_unfiltered", "box"):
        name = f"length_most_revolutions_{region}_rad_s"
        wanted = robustness(response_of(datasets, "Ref", "direct", region))["length_most_revolutions_rad_s"]
        assert table.loc["Ref", name] == pytest.approx(wanted, rel=1e-5)
    assert np.isnan(table.loc["Odd", "length_most_revolutions_box_rad_s"])


def test_the_summary_has_the_place(responses):
    response = read_judged(responses["Ref", "direct"])
    (row,) = [row for row in find_interactions(response, xr.Dataset(), InteractionChoice()) if row["max_von_mises_span"] > 0.0]
    worst = response.isel(speed=int(np.argmax(response["max_von_mises_inside"].values)))
    for name in ("span", "chord", "side"):
        assert row[f"max_von_mises_{name}"] == worst[f"max_von_mises_{name}"]
