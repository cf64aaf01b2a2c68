"""Numbers of a whole rotor: who leads, waves, growth, runs that diverge; their dataset, table, figure and plan."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import xarray as xr
from integration_runs import ENGINES
from test_rotor import CHOICE, KEPT, LINED_RING, RING, SPEED, STEEP, a_blade, rotor_of, run, samples

from r37core.base.dataset_file import attributes_of, joined_hash, read_dataset, write_dataset
from r37core.base.io import Named
from r37core.results.events import Danger
from r37core.results.limits import Cause
from r37core.results.table_file import read_table
from r37core.stress.operator import StressOperator
from r37core.time_integration.kept_numbers import KEPT as KEPT_DIRECTIONS
from r37core.time_integration.kept_numbers import amplitudes
from r37core.time_integration.rotor_blades import mistuned
from r37core.time_integration.rotor_numbers import MOST_GROWTH, nodal_diameters, span_maxima
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.speed_run import numbers_of_run, run_speed
from r37studies.rotors.dataset import rotor_dataset, rotor_table
from r37studies.rotors.figures import draw_rotor
from r37studies.rotors.steps import join, rotor_of_run


def test_a_wave_of_nodal_diameters_is_found():
    """x_b(t) = cos(w t - n theta_b), seen by blades whose samples are not those of the same instants."""
    rotor, count = rotor_of(12), 256
    late = np.random.default_rng(0).random(12)
    time = 2.0 * np.pi * (np.arange(count) + late[:, None]) / count
    for diameters in (-5, 0, 3, 6):
        motion = np.cos(9.0 * time - diameters * np.array(rotor.angles)[:, None]) + 0.5
        found = nodal_diameters(motion[..., None], late, rotor)
        share = dict(zip(found["nodal_diameter"].tolist(), found["nodal_diameter_share"], strict=True))
        assert share[diameters] == pytest.approx(1.0, abs=1e-9)
        assert sum(share.values()) == pytest.approx(1.0)
    # a wave of twice the size along another direction has four fifths
    other = 2.0 * np.cos(9.0 * time - 2.0 * np.array(rotor.angles)[:, None])
    both = nodal_diameters(np.stack([motion, other], axis=-1), late, rotor)
    share = dict(zip(both["nodal_diameter"].tolist(), both["nodal_diameter_share"], strict=True))
    assert (share[2], share[6]) == (pytest.approx(0.8), pytest.approx(0.2))
    assert np.isnan(nodal_diameters(np.zeros((12, count, 1)), late, rotor)["nodal_diameter_share"]).all()


def test_growth_is_kept_in_spans_of_revolutions():
    values = np.arange(2.0 * (2 * MOST_GROWTH + 1)).reshape(2, -1)
    spans, span = span_maxima(values)
    assert span == 3 and spans.shape == (2, 134) and spans.dtype == np.float32
    np.testing.assert_array_equal(spans[:, [0, 1, -2, -1]], [[2, 5, 398, 400], [403, 406, 799, 801]])
    assert [span_maxima(np.zeros((1, count)))[1] for count in (1, MOST_GROWTH, MOST_GROWTH + 1, 20000)] == [1, 1, 2, 100]


MODES = tuple(replace(mode, modal_mass=1e6 * mode.modal_mass) for mode in RING.modes())
HEAVY = replace(STEEP, casing=replace(STEEP.casing, ring=MODES))
CASINGS = {"rigid": STEEP, "elastic": HEAVY, "elastic, no lining": replace(HEAVY, lining=None)}
RECORDED = replace(CHOICE, snapshots_per_revolution=16, snapshot_revolutions=2)
RESULTS = ("spectrum", "stress", "energy")
STRESS = StressOperator(np.random.default_rng(0).random((6, 5, len(a_blade().to_reduced))), len(a_blade().to_reduced), "tip")


def numbers_of(scene, rotor, choice=RECORDED, engine="compiled"):
    results = (*RESULTS, *(["wear"] if scene.lining else []), *(["casing"] if scene.casing.ring else []))
    return numbers_of_run(run(rotor, scene, choice, engine), results, stress={"one": STRESS}, **KEPT)


@cache
def undisturbed(casing, longest):
    """Rotor of three blades of which one is longer, and the largest displacement of each in every sample."""
    rotor = rotor_of(3, longer=[1e-4 if place == longest else 0.0 for place in range(3)])
    return rotor, np.abs(samples(run(rotor, CASINGS[casing]))).max(axis=-1)


@pytest.mark.parametrize("late", [False, True], ids=["first revolution", "later"])
@pytest.mark.parametrize("longest", [0, 1, 2])
@pytest.mark.parametrize("casing", CASINGS)
def test_any_blade_may_diverge_first(casing, longest, late, tmp_path):
    """The run ends as a result that says so, with the number of the blade and when it did."""
    rotor, sizes = undisturbed(casing, longest)
    own, others = sizes[longest], np.delete(sizes, longest, axis=0).max()
    first = own[: CHOICE.samples_per_revolution].max()
    limit = 0.5 * (first + (own.max() if late else others))
    numbers = numbers_of(replace(CASINGS[casing], divergence_limit=limit), rotor)
    assert numbers["status"] == 1 and numbers["leader"] == longest + 1
    reached = (np.argmax(own > limit) + 1) / CHOICE.samples_per_revolution
    assert numbers["diverged_revolution"] == reached and (reached > 1.0) == late
    for name in ("rms_normal", "peak_normal", "amplitude", "blade_rms", "blade_peak", "nodal_diameter_share"):
        assert np.isnan(numbers[name]).all(), name
    assert np.isnan(numbers["max_von_mises_last_revolution"]) and np.isnan(numbers["blade_revolution_von_mises"][longest]).any()
    assert np.isfinite(numbers["blade_worn"]).all() and (numbers["blade_maximum"][longest, 0] > 0.0) == late
    write_speed(numbers, tmp_path / "speed.npz", {})
    dataset = rotor_dataset([tmp_path / "speed.npz"], [SPEED], 1e9)
    assert dataset["status"] == 1 and dataset["leader"] == longest + 1
    for name in ("share_of_revolutions_above_yield", "max_von_mises_ever"):
        assert np.isnan(dataset[f"blade_{name}"]).all()


@pytest.mark.parametrize("engine", ENGINES)
def test_all_blades_may_diverge_at_once(engine):
    """A casing beyond the limit is a divergence of all blades; the first one stands for them."""
    scene = replace(LINED_RING, divergence_limit=1e-5)
    choice = replace(RECORDED, revolutions=2, snapshot_revolutions=1)
    assert all(part.diverged for part in run(rotor_of(3), scene, choice, engine).records)
    numbers = numbers_of(scene, rotor_of(3), choice, engine)
    assert numbers["status"] == 1 and numbers["leader"] == 1 and np.isnan(numbers["blade_rms"]).all()


def test_of_blades_that_diverge_in_one_pass_the_first_in_time_leads():
    """Blade after blade passes the casing: the third is beyond the limit before the first, which is so earlier, has begun."""
    rotor, sizes = undisturbed("rigid", 2)
    limit = 0.5 * sizes.max(axis=1).min()
    ends = np.argmax(sizes > limit, axis=1) + 1
    done = run(rotor, replace(STEEP, divergence_limit=limit))
    assert [part.diverged for part in done.records] == [True, False, True] and ends[0] < ends[2] < ends[1]
    assert done.first_diverged == 0 and len(done.records[0].samples) == ends[0]
    numbers = numbers_of(replace(STEEP, divergence_limit=limit), rotor)
    assert numbers["leader"] == 1 and numbers["diverged_revolution"] == ends[0] / CHOICE.samples_per_revolution


def test_dataset_table_and_figure(tmp_path):
    """The steps of the workflow, of two rotors of which one has its stress recorded."""
    runs, files, speeds = [("Ref", "many"), ("Ref", "few")], [], [990.0, 1000.0, 1010.0]
    for (_, name), blades, choice in zip(runs, (6, 2), (replace(RECORDED, revolutions=3), CHOICE), strict=True):
        rotor = rotor_of(blades, factors=list(np.linspace(0.99, 1.01, blades)), longer=[1e-5] * blades)
        written = [str(tmp_path / f"{name}_{speed}.npz") for speed in speeds]
        for speed, file in zip(speeds, written, strict=True):
            results = ("wear", "stress") if name == "many" else ("wear",)
            scene = replace(STEEP, rotor=rotor)
            write_speed(run_speed(a_blade(), speed, scene, choice, results, stress={"one": STRESS}, **KEPT), file, {})
        files.append(str(tmp_path / f"{name}.nc"))
        params = Named(speeds=speeds, yield_stress=2e-5, provenance={"made": name})
        rotor_of_run(Named(speeds=written), Named(rotor=files[-1]), params)
    made = Named(dataset=tmp_path / "rotor.nc", table=tmp_path / "rotors.csv")
    join(Named(rotors=files), made, Named(runs=runs, fidelity="draft"))
    together, table, many = read_dataset(made.dataset), read_table(made.table), read_dataset(files[0])
    assert together.attrs["fidelity"] == "draft" and together.attrs["input_hash"] == joined_hash(attributes_of(files))
    assert many.attrs["made"] == "many" and many["status"].attrs["flag_meanings"].startswith("completed diverged")
    assert together.sizes["run"] == 6 and together.sizes["blade_number"] == 6
    assert together["blade"].values.tolist() == ["Ref"] * 6 and together["speed"].values.tolist() == 2 * speeds
    of_few = together["blade_rms"].sel(run=together["scene"] == "few")
    assert np.isfinite(of_few).sum() == 6
    assert table["blades"].tolist() == [6, 2] and table["leader_by_stress"].isna().tolist() == [False, True]
    # what no speed changes has no dimension of it, and spans end with the run
    assert many["blade_longer"].values.tolist() == [1e-5] * 6 and many["yield_stress"] == 2e-5
    assert many["span"].values.tolist() == [1, 2, 3] and many["stress_span"].values.tolist() == [2, 3]
    assert many["lobes"].values.tolist() == list(range(many.sizes["lobes"])) and many.sizes["lobes"] > 3
    assert "6 blades" in draw_rotor(many, "Ref, many").get_suptitle()


def test_stress_of_mistuned_blades_is_that_of_single_ones():
    """Blades that are looked at together follow their forces as their own flexibility says."""
    factors = [1.0, 1.2, 0.8, 1.1]
    rotor = rotor_of(4, np.pi * np.arange(4), factors, shared=False)
    numbers = numbers_of(STEEP, rotor)
    for place, factor in enumerate(factors):
        alone = run_speed(mistuned(a_blade(), factor), SPEED, STEEP, RECORDED, ("stress",), stress={"one": STRESS}, **KEPT)
        np.testing.assert_allclose(numbers["blade_revolution_von_mises"][place], alone["revolution_von_mises"][0], rtol=1e-4)


def test_spans_of_a_long_run_end_with_it(tmp_path):
    revolutions = 2 * MOST_GROWTH + 1
    choice = replace(RECORDED, revolutions=revolutions, snapshot_revolutions=300)
    numbers = numbers_of(STEEP, rotor_of(1), choice)
    assert numbers["span_revolutions"] == 3 and numbers["blade_revolution_von_mises"].shape == (1, 300)
    write_speed(numbers, tmp_path / "speed.npz", {})
    dataset = rotor_dataset([tmp_path / "speed.npz"], [SPEED], 1e9)
    assert dataset["span"][[0, -2, -1]].values.tolist() == [3, revolutions - 2, revolutions]
    assert dataset["stress_span"][[0, -2, -1]].values.tolist() == [revolutions - 149 * 2, revolutions - 2, revolutions]
    # the share is of the last half's revolutions, not of spans or of all that are recorded
    stress = np.sort(numbers["blade_revolution_von_mises"][0, -int(numbers["statistic_revolutions"]) :])
    third = float(stress[len(stress) // 3])
    judged = rotor_dataset([tmp_path / "speed.npz"], [SPEED], third)
    assert judged["blade_share_of_revolutions_above_yield"].item() == np.mean(stress > third)
    assert judged["blade_max_von_mises_ever"].item() == judged["max_von_mises_ever"].item() == pytest.approx(stress[-1])
    assert judged["yield_danger"] == Danger.UNKNOWN and judged["exit_cause"] > Cause.NONE
    # where one blade diverged, nothing is known of those that went on to the end
    write_speed(numbers | {"status": np.array(1)}, tmp_path / "lost.npz", {})
    lost = rotor_dataset([tmp_path / "lost.npz"], [SPEED], third)
    assert np.isnan(lost["blade_share_of_revolutions_above_yield"]) and np.isnan(lost["blade_max_von_mises_ever"])


def test_the_leader_moves_most_in_both_directions_together():
    """The third blade moves most along the normal, the second one along the tangent, by more."""
    rotor = rotor_of(3, longer=[0.0, 1e-4, 0.0])
    motion = samples(run(rotor)).reshape(3, CHOICE.revolutions, -1, 2, 3)[:, :, :, 0, KEPT_DIRECTIONS]
    half = motion[:, CHOICE.revolutions // 2 :].reshape(3, -1, 2)
    numbers = run_speed(a_blade(), SPEED, replace(STEEP, rotor=rotor), CHOICE, ("spectrum",), **KEPT)
    assert np.argmax(np.sum(half**2, axis=1), axis=0).tolist() == [2, 1] and numbers["leader"] == 2
    np.testing.assert_allclose(numbers["blade_rms"], np.sqrt(np.mean(np.sum(half**2, axis=2), axis=1)), rtol=1e-12)
    np.testing.assert_allclose(numbers["blade_peak"], np.hypot(*half.T).T.max(axis=1), rtol=1e-12)
    np.testing.assert_allclose(numbers["blade_maximum"], np.hypot(*motion.T).T.max(axis=2), rtol=1e-6)
    of_leader = amplitudes(half[1].T)[:, : len(numbers["engine_order"])]
    np.testing.assert_allclose([numbers["amplitude"], numbers["amplitude_tangential"]], of_leader, rtol=1e-5)
    found = nodal_diameters(half, run(rotor).late, rotor)
    # the last bit of a matrix product depends on where its arrays lie in memory
    np.testing.assert_allclose(numbers["nodal_diameter_share"], found["nodal_diameter_share"], rtol=1e-12)


SPANS = 41


def a_rotor(rms, stress=None, status=None, leader=None, share=None):
    """rotor.nc at speeds of 900, 910, ... rad/s, of blades 1, 3, 5, ...; stresses in GPa and in a yield stress of 1 GPa.

    The motion in spans of two revolutions is a tenth of the rms, two tenths and so on. `share` of the revolutions above yield
    at each speed of a blade that ever is.
    """
    rms, numbers = np.array(rms, dtype=float), 1 + 2 * np.arange(len(rms[0]))
    speeds, spans = 900.0 + 10.0 * np.arange(len(rms)), np.arange(1, SPANS + 1)
    by_blade, one = ("speed", "blade_number"), np.ones(len(numbers))
    data = {
        "blade_rms": (by_blade, rms),
        "blade_maximum": ((*by_blade, "span"), 0.1 * rms[:, :, None] * spans),
        "leader": ("speed", numbers[np.nan_to_num(rms).argmax(axis=1)] if leader is None else leader),
        "status": ("speed", np.zeros(len(rms), int) if status is None else status),
        "nodal_diameter_share": (("speed", "nodal_diameter"), np.where(np.isnan(rms[:, :1]), np.nan, [[0.1, 0.2, 0.7]])),
        "yield_stress": 1e9,
        "lined": 1.0,
        # the last speed leaves the model
        "exit_revolution": ("speed", np.where(np.arange(len(rms)) < 1, np.nan, 5.0)),
        "exit_cause": ("speed", np.where(np.arange(len(rms)) < 1, Cause.NONE, Cause.HEAT)),
        **{name: ("blade_number", one) for name in ("blade_angle", "blade_frequency_factor", "blade_longer")},
    }
    if stress is not None:
        of_blades = 1e9 * np.array(stress)
        above = np.where(np.isnan(of_blades), np.nan, of_blades > 1e9) * np.reshape(1.0 if share is None else share, (-1, 1))
        data |= {"blade_max_von_mises_ever": (by_blade, of_blades), "blade_share_of_revolutions_above_yield": (by_blade, above)}
        data |= {f"max_von_mises_{name}": ("speed", of_blades.max(axis=1)) for name in ("ever", "inside")}
        data |= {"share_of_revolutions_above_yield": ("speed", above.max(axis=1))}
    axes = {"speed": speeds, "speed_rpm": ("speed", 9.55 * speeds), "blade_number": numbers, "span": 2 * spans}
    return xr.Dataset(data, axes | {"nodal_diameter": [-1, 0, 1]})


def files_of(tmp_path, rotors):
    files = {("Ref", name): tmp_path / f"{name}.nc" for name in rotors}
    for name, rotor in rotors.items():
        write_dataset(rotor, files["Ref", name])
    return files


def rows_of(tmp_path, **rotors):
    return rotor_table(files_of(tmp_path, rotors)).set_index("scene")


def test_the_table_has_the_worst_speed_and_who_leads_there(tmp_path):
    rms = [[1.0, 2.0, 4.0], [8.0, 3.0, 1.0], [2.0, 9.0, 1.0]]
    stress = [[0.5, 0.5, 0.5], [1.5, 2.5, 0.5], [1.1, 2.0, 1.1]]
    table = rows_of(tmp_path, stressed=a_rotor(rms, stress, share=[1.0, 1.0, 0.3]), moving=a_rotor(rms))
    row = table.loc["stressed"]
    assert (row["worst_speed_rad_s"], row["leader_by_motion"], row["leader_by_stress"]) == (910.0, 1, 3)
    assert (row["leader_motion_m"], row["median_motion_m"], row["largest_stress_pa"]) == (8.0, 3.0, 2.5e9)
    assert (row["blades"], row["speeds"], row["diverged_speeds"]) == (3, 3, 0)
    assert row["blades_above_yield"] == 2
    assert (row["nodal_diameter"], row["nodal_diameter_share"]) == (1, 0.7)
    row = table.loc["moving"]
    assert (row["worst_speed_rad_s"], row["leader_by_motion"], row["median_motion_m"]) == (920.0, 3, 2.0)
    assert np.isnan(row["leader_by_stress"]) and np.isnan(row["largest_stress_pa"])


def test_speeds_that_diverged_in_the_table(tmp_path):
    lost, status = [np.nan] * 2, [0, 1, 0]
    part = a_rotor([[1.0, 2.0], lost, [3.0, 1.0]], [[0.4, 0.5], lost, [0.5, 0.6]], status, [3, 1, 1])
    none = a_rotor([lost, lost], [lost, lost], [1, 1], [3, 1])
    table = rows_of(tmp_path, part=part, none=none)
    row = table.loc["part"]
    names = ["diverged_speeds", "worst_speed_rad_s", "leader_by_motion", "leader_by_stress"]
    assert row[names].tolist() == [1, 920.0, 1, 3]
    assert row["blades_above_yield"] == 0
    row = table.loc["none"]
    assert (row["diverged_speeds"], row["leader_by_motion"], row["blades_above_yield"]) == (2, 3, 0)
    assert row[["leader_by_stress", "nodal_diameter", "largest_stress_pa", "leader_motion_m"]].isna().all()


def test_the_figure_shows_all_blades_and_names_those_that_move_most():
    rms = 1e-3 * np.array([[3.0, 1.0, 4.0, 2.0, 5.0], [1.0, 1.0, 1.0, 1.0, 2.0]])
    figure = draw_rotor(a_rotor(rms, [[0.5, 2.0, 3.0, 0.1, 0.2], [0.1, 0.2, 0.3, 0.4, 0.5]]), "Ref")
    row, blades, stress, growth, waves = figure.axes[:5]
    assert [text.get_text() for text in row.texts] == ["by heat"]
    (cells,) = blades.images
    np.testing.assert_allclose(cells.get_array(), 1e3 * rms.T)
    assert (cells.norm.vmin, cells.norm.vmax) == (pytest.approx(5e-3), 5.0)
    worst, _, median = stress.lines[:3]
    np.testing.assert_allclose(worst.get_ydata(), [3.0, 0.5])
    np.testing.assert_allclose(median.get_ydata(), [0.5, 0.3])
    assert stress.get_title() == "at most 2 of 5 blades above yield in most revolutions"
    names = [line.get_label() for line in growth.lines]
    assert names[2:] == ["blade 9", "blade 5", "blade 1"] and all(name.startswith("_") for name in names[:2])
    for line, size in zip(growth.lines, (2.0, 1.0, 5.0, 4.0, 3.0), strict=True):
        np.testing.assert_allclose(line.get_ydata(), 0.1 * size * np.arange(1, SPANS + 1))
    assert "at 900 rad/s" in growth.get_xlabel()
    assert [bar.get_height() for bar in waves.patches] == pytest.approx([10.0, 20.0, 70.0])
    assert [bar.get_x() + 0.5 * bar.get_width() for bar in waves.patches] == pytest.approx([-1.0, 0.0, 1.0])


def test_the_figure_of_one_speed_or_without_stress_has_lines():
    rms = 1e-3 * np.array([[3.0, 1.0], [4.0, 2.0]])
    figure = draw_rotor(a_rotor(rms), "Ref")
    np.testing.assert_allclose(figure.axes[2].lines[0].get_ydata(), [3.0, 4.0])
    assert len(figure.axes[1].images) == 1 and "at 910 rad/s" in figure.axes[3].get_xlabel()
    for rotor in (a_rotor(rms[:1]), a_rotor(rms[:, :1])):
        figure = draw_rotor(rotor, "Ref")
        lines = figure.axes[1].lines
        np.testing.assert_allclose([line.get_ydata() for line in lines], 1e3 * rotor["blade_rms"].values.T)
        assert not figure.axes[1].images and figure.axes[1].get_ylabel() == "rms of the motion (mm)"
    lost = a_rotor([[np.nan, np.nan]], None, [1], [3])
    figure = draw_rotor(lost, "Ref")
    assert figure.axes[1].lines[-1].get_ydata().tolist() == [0.0]
