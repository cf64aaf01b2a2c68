"""Fatigue: stress of a run's revolutions and its share of the Goodman line; cycles of a run-up, summed by Miner's rule."""

from dataclasses import replace

import numpy as np
import pytest
from box_mesh import inner_places
from box_operator import box_operator
from defaults import IntegrationChoice
from integration_cases import DIRECT, NARROW

from r37core.base.dataset_file import read_dataset
from r37core.config.changed_numbers import ImpossibleValueError, blade_number, changed_blade
from r37core.contact.scene import Rotor
from r37core.fem.stress import recovered_stress
from r37core.figures.fatigue_map import draw_fatigue, draw_fatigue_map
from r37core.mesh.mesh_files import write_vtu
from r37core.results.datasets import write_sweep_dataset
from r37core.results.ranking import robustness
from r37core.results.regions import read_judged
from r37core.results.response import write_response
from r37core.rom.rom_file import write_reduced_model
from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.cycles import StressCycles, rainflow_cycles
from r37core.stress.operator import StressOperator, von_mises
from r37core.stress.recovery import stress_operators
from r37core.stress.revolutions import largest_cycles, stress_cycles
from r37core.stress.statistic import Strengths, goodman_statistic
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import read_speed, write_speed
from r37core.time_integration.speed_run import numbers_of_run, run_speed

XX, YY, ZZ, XY = range(4)
PER_REVOLUTION, REVOLUTIONS = 48, 5
PHASE = 2.0 * np.pi * np.arange(PER_REVOLUTION * REVOLUTIONS) / PER_REVOLUTION
KEPT = {"spectrum_highest_order": 5, "wear_angles": 60}
CHOICE = IntegrationChoice(8e-7, 6, 62, integrator="exact_modal", snapshots_per_revolution=31, snapshot_revolutions=6)


def cycles_of(components, states):
    """Alternating and mean stress of one node whose stress components (number -> row) answer the states with unit stress."""
    operator = np.zeros((6, 1, states.shape[1]))
    for component, row in components.items():
        operator[component, 0] = row
    count = states.shape[1]
    stress = StressOperator(operator, count, "")
    alternating, mean = stress_cycles(stress, states, np.eye(count), np.empty(0), PER_REVOLUTION, len(states) // PER_REVOLUTION)
    assert alternating.shape == (REVOLUTIONS, 1)
    return alternating, mean


def test_a_uniaxial_cycle_is_the_textbook_s():
    """Amplitude over fatigue strength and mean over ultimate strength, of a sine about a mean; compression does not help."""
    alternating, mean = cycles_of({XX: [1.0]}, (120.0 + 300.0 * np.sin(PHASE))[:, None])
    np.testing.assert_allclose(alternating, 300.0, rtol=1e-6)
    np.testing.assert_allclose(mean, 120.0, rtol=1e-6)
    share = Strengths(500.0, 1000.0).share(alternating[0], mean)
    np.testing.assert_allclose(share, 300.0 / 500.0 + 120.0 / 1000.0, rtol=1e-6)
    # what stays is a mean alone
    alternating, mean = cycles_of({XX: [1.0], YY: [0.5], XY: [2.0]}, np.full((len(PHASE), 1), 80.0))
    np.testing.assert_allclose(alternating, 0.0, atol=1e-4)
    np.testing.assert_allclose(mean, 120.0, rtol=1e-6)
    strengths = Strengths(500.0, 1000.0)
    assert strengths.share(np.array(100.0), np.array(-400.0)) == pytest.approx(0.2)
    assert np.isnan(Strengths().share(np.array([100.0]), np.array([0.0]))).all()


@pytest.mark.parametrize(("yy", "alternating"), [(-1.0, np.sqrt(3.0)), (1.0, 1.0), (0.0, 1.0)])
def test_components_keep_their_signs(yy, alternating):
    """Two normal stresses in antiphase are a shear of twice their von Mises stress' third; in phase they are one."""
    stress, _ = cycles_of({XX: [1.0], YY: [yy]}, np.sin(PHASE)[:, None])
    np.testing.assert_allclose(stress, alternating, rtol=1e-6)


def test_a_path_counts_by_its_farthest_point_from_the_mean():
    """Out of phase, |s|^2 = sin^2 + 3 (2 cos)^2; a wave at 1 for an eighth of the time has the mean 1/8, farthest 7/8."""
    alternating, _ = cycles_of({XX: [1.0, 0.0], XY: [0.0, 2.0]}, np.stack([np.sin(PHASE), np.cos(PHASE)], axis=1))
    np.testing.assert_allclose(alternating, np.sqrt(12.0), rtol=1e-6)
    wave = (np.arange(len(PHASE)) % 8 == 0).astype(float)
    np.testing.assert_allclose(cycles_of({XX: [1.0]}, wave[:, None])[0], 7.0 / 8.0, rtol=1e-6)


@pytest.mark.parametrize("seed", range(4))
def test_few_pairs_say_what_all_nodes_say(seed):
    """Of each revolution and for any strengths; compression among the means, and nodes of the same stress."""
    random = np.random.default_rng(seed)
    alternating = random.gamma(3.0, 1e8, (30, 500)).astype(np.float32)
    mean = random.normal(5e7, 1e8, 500).astype(np.float32)
    alternating[:, 20:40], mean[20:40] = alternating[:, :20], mean[:20]
    largest, means, counts = largest_cycles(alternating, mean)
    assert counts.sum() == len(means) == len(largest) < 0.03 * alternating.size
    starts = np.cumsum(counts) - counts
    for fatigue in (1e7, 1e8, 4e8, 1e10):
        for ultimate in (2e7, 9e8, 1e11):
            strengths = Strengths(fatigue, ultimate)
            shares = np.maximum.reduceat(strengths.share(largest, means), starts)
            np.testing.assert_array_equal(shares, strengths.share(alternating, mean).max(axis=1))


def test_without_vibration_the_largest_mean_is_left():
    largest, means, counts = largest_cycles(np.zeros((2, 3), np.float32), np.array([1e8, 3e8, 2e8], np.float32))
    assert (largest.tolist(), means.tolist(), counts.tolist()) == ([0.0, 0.0], [3e8, 3e8], [1, 1])


def test_numbers_of_known_revolutions():
    """Shares 0.5 and 0.4 in the first revolution, 1.2 in the second, 0.9 in the third."""
    run = {"cycle_alternating": np.array([4.0, 2.0, 11.0, 6.0]), "cycle_mean": np.array([2.0, 4.0, 2.0, 6.0])}
    run["statistic_revolutions"] = np.array(3)
    found = goodman_statistic({**run, "cycle_counts": np.array([[2, 1, 1]])}, Strengths(10.0, 20.0))
    wanted = {"goodman_share": 1.2, "goodman_share_median": 0.9, "share_of_revolutions_above_goodman": 1 / 3}
    wanted |= {"goodman_alternating_stress": 11.0, "goodman_mean_stress": 2.0, "fatigue_strength": 10.0}
    assert found == {name: pytest.approx(value) for name, value in (wanted | {"ultimate_strength": 20.0}).items()}


@pytest.fixture(scope="module")
def stress(model, steel):
    return {"box": box_operator(model, steel)}


@pytest.fixture(scope="module")
def a_run(contact, stress):
    """A run that is done, and the numbers kept of it."""
    run = Simulation(contact, 1340.0, DIRECT, CHOICE).run()
    return run, numbers_of_run(run, ("stress", "fatigue"), stress=stress, **KEPT)


def test_three_nodes_of_a_blade_by_hand(a_run, whole, mesh, model, steel):
    """The displacement of the whole mesh at each instant, its stress tensors, their later mean, and the difference from it."""
    run, numbers = a_run
    problem, region = run.problem, model.stress_regions["box"].nodes.nodes
    places = inner_places(model, mesh)
    # the statistic has half of the six revolutions
    later = 3 * CHOICE.snapshots_per_revolution
    states = run.records[0].snapshots @ (problem.model.to_reduced @ problem.contact.state_shapes).T
    fields = whole.whole_blade
    order = np.argsort(fields.nodes)
    amplitudes = rotation_amplitudes(whole.rotation_stiffening, 1340.0)
    displacement = np.einsum("nxj,tj->nxt", fields.basis[order], states)
    displacement += (fields.rotation_shapes[order] @ amplitudes)[..., None]
    tensors = recovered_stress(mesh.blocks, mesh.points, displacement, steel, False)[:, region[places]]
    mean = tensors[..., -later:].mean(axis=2, keepdims=True)
    alternating = von_mises(tensors - mean).max(axis=1)
    assert alternating.min() > 1e7
    np.testing.assert_allclose(numbers["alternating_stress"][places], alternating, rtol=1e-5)
    np.testing.assert_allclose(numbers["mean_stress"][places], mean[:3, :, 0].sum(axis=0), rtol=1e-4, atol=1e3)
    assert numbers["cycle_counts"].shape == (1, 6)


def test_rotation_is_in_the_mean_whatever_the_scene_asks_for(a_run, contact, stress):
    _, numbers = a_run
    kept = run_speed(contact, 1340.0, DIRECT, CHOICE, ("stress", "static_stress", "fatigue"), stress=stress, **KEPT)
    for name in ("mean_stress", "alternating_stress", "cycle_mean", "cycle_alternating", "cycle_counts"):
        np.testing.assert_array_equal(kept[name], numbers[name])
    assert kept["max_von_mises_last_revolution"] != numbers["max_von_mises_last_revolution"]


def test_a_rotor_has_the_largest_of_its_blades(contact, stress):
    """Two blades, each on a lining of its own, are two single ones: in each revolution the larger share counts."""
    choice = replace(CHOICE, revolutions=4, snapshot_revolutions=4)
    angles, factors, longer = (0.0, np.pi), (1.0, 1.03), (0.0, 1e-4)

    def shares(places):
        chosen = ([values[place] for place in places] for values in ((1, 2), angles, factors, longer))
        scene = replace(NARROW, rotor=Rotor(*map(tuple, chosen), shared_lining=False))
        run = run_speed(contact, 1340.0, scene, choice, ("stress", "fatigue"), stress=stress, **KEPT)
        share = Strengths(3e8, 5e8).share(run["cycle_alternating"], run["cycle_mean"])
        return np.maximum.reduceat(share, np.cumsum(run["cycle_counts"][0]) - run["cycle_counts"][0])

    alone = [shares([place]) for place in range(2)]
    np.testing.assert_allclose(shares([0, 1]), np.maximum(*alone), rtol=1e-6)
    # of the later revolutions
    assert np.abs(alone[0] - alone[1])[2:].min() > 0.01 * alone[0].max()


SPEEDS = [1000.0, 1340.0, 1700.0]


@pytest.fixture(scope="module")
def swept(contact, stress, tmp_path_factory):
    """Files of three speeds in direct contact, of which the last one diverges."""
    folder = tmp_path_factory.mktemp("fatigue")
    files = [folder / f"{speed:g}.npz" for speed in SPEEDS]
    for speed, file in zip(SPEEDS, files, strict=True):
        scene = replace(DIRECT, divergence_limit=1e-7) if speed == SPEEDS[-1] else DIRECT
        write_speed(run_speed(contact, speed, scene, CHOICE, ("stress", "fatigue"), stress=stress, **KEPT), file, {})
    return folder, files


@pytest.fixture(scope="module")
def responses(swept):
    """Responses of the same files with strengths and without, by blade and scene."""
    folder, files = swept
    made = {}
    for blade, strengths in {"Strong": Strengths(3e8, 5e8), "Unknown": Strengths()}.items():
        made[blade, "direct"] = folder / f"{blade}.nc"
        limits = {"yield_stress": 1e9, "strengths": strengths}
        write_response(files, SPEEDS, made[blade, "direct"], stress_history_speeds=(), **limits, provenance={})
    return made


def test_a_response_has_the_shares_of_its_speeds(swept, responses):
    response = read_judged(responses["Strong", "direct"])
    for number, file in enumerate(swept[1]):
        found = goodman_statistic(read_speed(file), Strengths(3e8, 5e8))
        assert len(found) == 7
        for name, value in found.items():
            np.testing.assert_array_equal(response[name].values[number] if response[name].ndim else response[name], value)
    for share in ("goodman_share", "share_of_revolutions_above_goodman"):
        assert response[share].notnull().values.tolist() == [True, True, False]
    of_nodes = Strengths(3e8, 5e8).share(response["alternating_stress"].values, response["mean_stress"].values)
    np.testing.assert_array_equal(of_nodes.max(axis=1), response["goodman_share"])
    unknown = read_judged(responses["Unknown", "direct"])
    assert unknown["goodman_share"].isnull().all() and unknown["share_of_revolutions_above_goodman"].isnull().all()
    assert np.isinf(unknown["fatigue_strength"])


def test_the_dataset_holds_blades_with_strengths_and_without(responses, tmp_path):
    write_sweep_dataset("fatigue", responses, tmp_path / "fatigue.nc", {})
    joined = read_judged(tmp_path / "fatigue.nc")
    shares = joined["goodman_share"].sel(scene="direct").notnull()
    assert shares.sel(blade="Strong").values.tolist() == [True, True, False] and not shares.sel(blade="Unknown").any()
    assert not {"alternating_stress", "stress_node"} & set(joined.variables)


def test_lengths_above_the_line(responses):
    """Of straight lines between the speeds; a diverged run is above in all revolutions."""
    response = read_judged(responses["Strong", "direct"])
    shares = ("speed", [0.0, 1.0, np.nan])
    measures = robustness(response.assign(share_of_revolutions_above_goodman=shares, lined=1.0))
    assert measures["length_goodman_rad_s"] == pytest.approx(170.0 + 360.0)
    assert measures["goodman_integral_rad_s"] == pytest.approx(170.0 + 360.0)
    assert measures["largest_goodman_share"] == response["goodman_share"].max()
    unknown = robustness(read_judged(responses["Unknown", "direct"]))
    assert all(np.isnan(unknown[name]) for name in unknown if "goodman" in name)
    assert unknown["length_most_revolutions_rad_s"] >= 0.0


def test_the_picture_shows_the_worst_speed(responses, model, mesh, tmp_path):
    write_vtu(mesh, tmp_path / "mesh.vtu", np.ones(sum(map(len, mesh.blocks.values()))))
    region = model.stress_regions["box"].nodes.nodes
    figures = [
        draw_fatigue(tmp_path / "mesh.vtu", mesh.points[region], read_judged(file), blade)
        for (blade, _), file in responses.items()
    ]
    worst = read_judged(responses["Strong", "direct"])["goodman_share"]
    title = f"Strong at {float(worst.idxmax()):g} rad/s: largest share {float(worst.max()):.3g}"
    assert figures[0].get_suptitle().startswith(title)
    pixels = figures[0].axes[1].images[0].get_array()
    # the colours of the map, and the red dot of the worst node on one of both sides
    assert np.any(np.ptp(pixels.astype(int), axis=2) > 60)
    assert figures[1].axes[0].texts[0].get_text() == "Unknown: no strengths in blades.yaml"


def test_the_picture_shows_the_region_that_decides(contact, model, mesh, steel, tmp_path):
    """Its number is that of the verdict, also where few nodes of the region are evaluated and a later region has all."""
    stress = stress_operators(model, steel)
    write_speed(
        run_speed(contact, 1340.0, DIRECT, CHOICE, ("stress", "fatigue"), stress=stress, **KEPT), tmp_path / "1.npz", {}
    )
    limits = {"yield_stress": 1e9, "strengths": Strengths(3e8, 5e8)}
    write_response([tmp_path / "1.npz"], [1340.0], tmp_path / "1.nc", stress_history_speeds=(), **limits, provenance={})
    write_vtu(mesh, tmp_path / "mesh.vtu", np.ones(sum(map(len, mesh.blocks.values()))))
    write_reduced_model(model, tmp_path / "rom.nc", {})
    shares = read_dataset(tmp_path / "1.nc")["goodman_share"]
    judged = float(shares.isel(region=0).item())
    assert list(shares["region"].values)[::2] == ["airfoil", "box"] and judged != float(shares.sel(region="box").item())
    figure = draw_fatigue_map(tmp_path / "mesh.vtu", tmp_path / "rom.nc", read_judged(tmp_path / "1.nc"), "Ref")
    assert "5 to 90% span" in figure.get_suptitle() and f"largest share {judged:.3g}\n" in figure.get_suptitle()


def test_strengths_vary_and_change_no_model(with_blades):
    family = "vary: { material.fatigue_strength_pa: [3e+8, 4e+8] }"
    settings = with_blades(
        f"Mine: {{ base: Ref, material: {{ fatigue_strength_pa: 2e+8, ultimate_strength_pa: 1.6e+9 }}, {family} }}",
        blades=["Mine", "Ref"],
    )
    *designs, ref = settings.blades.values()
    assert [blade.strengths for blade in designs] == [Strengths(3e8, 1.6e9), Strengths(4e8, 1.6e9)]
    assert ref.strengths == Strengths() and ref.material.unusual == {}
    assert len({blade.elastic.material for blade in (*designs, ref)}) == 1
    key = "material.fatigue_strength_pa"
    assert blade_number(designs[0], key) == 3e8 and blade_number(ref, key) is None
    assert changed_blade(designs[0], {key: 5e8}).strengths == Strengths(5e8, 1.6e9)
    with pytest.raises(ImpossibleValueError, match="less than ultimate_strength_pa"):
        changed_blade(designs[0], {key: 1.7e9})


STEEL = Strengths(4e8, 1e9, cycles=1e6, exponent=5.0)


def test_the_example_of_the_standard():
    """ASTM E1049-85, figure 6: ranges 3, 4, 6, 8, 9, with points between the turning points that count for nothing."""
    series = np.array([-2.0, 1.0, -1.0, -3.0, 0.0, 5.0, -1.0, 3.0, 3.0, -4.0, 4.0, 1.0, -2.0])
    found = rainflow_cycles(series)
    counted = {}
    for amplitude, count in zip(found.amplitude, found.count, strict=True):
        counted[2.0 * amplitude] = counted.get(2.0 * amplitude, 0.0) + count
    assert counted == {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}


def test_a_harmonic_stress_about_a_mean():
    """A hundred cycles of 300 MPa about 250 MPa: an amplitude of 300/(1 - 250/1000) = 400 MPa, which is endured 1e6 times."""
    time = np.linspace(0.0, 100.0, 6401)
    cycles = rainflow_cycles(250e6 + 300e6 * np.cos(2.0 * np.pi * time))
    assert cycles.count.sum() == pytest.approx(100.0)
    assert STEEL.miner_sum(cycles) == pytest.approx(1e-4, rel=1e-3)
    doubled = StressCycles(2.0 * cycles.amplitude, cycles.mean, cycles.count)
    assert STEEL.miner_sum(doubled) == pytest.approx(32e-4, rel=1e-3)
    # compression does not help
    below = StressCycles(cycles.amplitude, -cycles.mean, cycles.count)
    assert STEEL.miner_sum(below) == pytest.approx(1e-4 * 0.75**5, rel=1e-3)


def test_damage_without_a_line_and_beyond_the_strength():
    cycles = StressCycles(np.array([1e8]), np.array([1e9]), np.array([1.0]))
    assert np.isnan(Strengths(4e8, 1e9).miner_sum(cycles))
    assert STEEL.miner_sum(cycles) == np.inf
    assert STEEL.miner_sum(rainflow_cycles(np.full(9, 1e8))) == 0.0
