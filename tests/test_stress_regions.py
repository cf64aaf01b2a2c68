"""Regions of the stress: which nodes are looked at, the modes that count, places, and where one of them is judged."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from integration_cases import DIRECT

from r37core.base.dataset_file import read_dataset
from r37core.base.io import Named
from r37core.results.columns import RANKING, column_named
from r37core.results.datasets import response_of, write_sweep_dataset
from r37core.results.interaction_choice import InteractionChoice
from r37core.results.interactions import find_interactions
from r37core.results.ranking import length_most_revolutions, robustness
from r37core.results.regions import judged, other_regions, read_judged
from r37core.results.response import write_response
from r37core.results.steps import ranking
from r37core.rom import stress_region
from r37core.rom.region_choice import RegionChoice
from r37core.stress.operator import mapped_region
from r37core.stress.recovery import stress_operators
from r37core.stress.revolutions import largest_of_revolutions
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.speed_run import numbers_of_run, run_speed

AIRFOIL = {"minimum_span": 0.05, "maximum_span": 0.9}
KEPT = {"spectrum_highest_order": 5, "wear_angles": 60}
CHOICE = IntegrationChoice(8e-7, 6, 62, integrator="exact_modal", snapshots_per_revolution=31, snapshot_revolutions=6)


@pytest.fixture(scope="module")
def every_node(reduced):
    """The model that looks at all nodes of the airfoil."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stress_region, "_MOST_NODES", 10**6)
        return reduced()


@pytest.mark.parametrize("speed", [1000.0, 1340.0, 1700.0])
def test_candidates_have_the_largest_stress_of_all_nodes(model, every_node, contact, steel, speed):
    """On this coarse mesh one of a hundred revolutions may differ, by 4% on one kind of processor, as the motion is chaotic."""
    few, all_nodes = (stress_operators(each, steel) for each in (model, every_node))
    assert len(few["airfoil"].places) < 0.15 * len(all_nodes["airfoil"].places)
    assert not few["airfoil"].is_complete and all_nodes["airfoil"].is_complete
    choice = replace(CHOICE, revolutions=40, snapshot_revolutions=40)
    run, results = Simulation(contact, speed, DIRECT, choice).run(), ("stress", "static_stress")
    found, wanted = (numbers_of_run(run, results, stress=each, **KEPT)["revolution_von_mises"] for each in (few, all_nodes))
    np.testing.assert_array_equal(found[2], wanted[2])
    ratio = found[:2] / wanted[:2]
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
    with pytest.raises(ValueError, match=r"no mode is below .*raise its highest_frequency_hz in structure\.stress_regions"):
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
    for name, place in zip(operators, kept["max_von_mises_place"], strict=True):
        assert (operators[name].places == place).all(axis=1).any()
    assert kept["max_von_mises_place"][0, 1] > kept["max_von_mises_place"][2, 1]
    diverged = run_speed(contact, 1340.0, replace(DIRECT, divergence_limit=2e-4), CHOICE, ("stress",), stress=operators, **KEPT)
    assert np.isnan(diverged["max_von_mises_place"]).all()


def test_a_map_shows_a_region_with_all_of_its_nodes(model):
    """But none without nodes, as the benchmark's box is to a blade of another place."""
    assert mapped_region(model.stress_regions) == "box"
    region = model.stress_regions["airfoil"]
    assert mapped_region({"airfoil": region}) == "airfoil"
    empty = replace(region, evaluated=region.evaluated[:0], nodes=replace(region.nodes, nodes=region.nodes.nodes[:0]))
    assert mapped_region({"first": replace(region, evaluated=region.evaluated[:5]), "empty": empty}) == "first"


SPEEDS = [1000.0, 1340.0, 1700.0]


@pytest.fixture(scope="module")
def responses(contact, model, steel, tmp_path_factory):
    """Two blades; the box of one of them has no elements."""
    folder, made = tmp_path_factory.mktemp("regions"), {}
    operators = stress_operators(model, steel)
    of_odd = {name: operators[name] for name in ("airfoil", "airfoil_unfiltered")}
    for blade, stress in {"Ref": operators, "Odd": of_odd}.items():
        files = [folder / f"{blade}_{speed:g}.npz" for speed in SPEEDS]
        for speed, file in zip(SPEEDS, files, strict=True):
            write_speed(run_speed(contact, speed, DIRECT, CHOICE, ("stress",), stress=stress, **KEPT), file, {})
        made[blade, "direct"] = folder / f"{blade}.nc"
        write_response(files, SPEEDS, made[blade, "direct"], stress_history_speeds=(), yield_stress=3e8, provenance={})
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
    np.testing.assert_array_equal(alone["max_von_mises"], whole["max_von_mises"].sel(region="airfoil"))
    assert judged(alone) is alone
    np.testing.assert_array_equal(response_of(datasets, "Ref", "direct")["max_von_mises"], alone["max_von_mises"])
    box = response_of(datasets, "Ref", "direct", "box")["max_von_mises"]
    np.testing.assert_array_equal(box, whole["max_von_mises"].sel(region="box"))


def test_a_blade_without_a_region_has_nothing_there(datasets):
    stress = datasets["stress"]
    assert stress["region"].values.tolist() == ["airfoil", "airfoil_unfiltered", "box"]
    odd = stress.sel(blade="Odd", scene="direct", region="box")
    assert odd["max_von_mises_median"].isnull().all() and odd["stress_region"].item() == ""
    assert other_regions(stress) == ["airfoil_unfiltered", "box"] and other_regions(judged(stress)) == []
    assert np.isnan(length_most_revolutions(response_of(datasets, "Odd", "direct", "box")))


def test_the_ranking_has_a_length_in_each_other_region(datasets, tmp_path):
    for kind, dataset in datasets.items():
        dataset.to_netcdf(tmp_path / f"{kind}.nc")
    table, pairs = tmp_path / "ranking.csv", [("Ref", "direct"), ("Odd", "direct")]
    given = Named(**{kind: tmp_path / f"{kind}.nc" for kind in datasets})
    ranking(given, Named(table=table), Named(runs=pairs, operating=None, contacts={"Ref": "8 points", "Odd": "8 points"}))
    table = pd.read_csv(table).set_index("blade")
    for region in ("airfoil_unfiltered", "box"):
        name = f"length_most_revolutions_{region}_rad_s"
        wanted = robustness(response_of(datasets, "Ref", "direct", region))["length_most_revolutions_rad_s"]
        assert table.loc["Ref", name] == pytest.approx(wanted, rel=1e-5)
        column = column_named(name, RANKING)
        assert column and region in column.title
    assert np.isnan(table.loc["Odd", "length_most_revolutions_box_rad_s"])
    assert column_named("length_most_revolutions_worst_rad_s", RANKING).title.endswith("worst motion")


def test_the_summary_has_the_place(responses):
    response = read_judged(responses["Ref", "direct"])
    (row,) = [row for row in find_interactions(response, xr.Dataset(), InteractionChoice()) if row["max_von_mises_span"] > 0.0]
    worst = response.isel(speed=int(np.argmax(response["max_von_mises_ever"].values)))
    for name in ("span", "chord", "side"):
        assert row[f"max_von_mises_{name}"] == worst[f"max_von_mises_{name}"]
