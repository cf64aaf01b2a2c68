"""A search from Python: it gives what the workflow gives, a design that cannot be built is a result, and bad input is told."""

import re
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from refusal_tables import pattern_of, refusal_rows
from workflow_runs import copy_finished, kill_snakemake, overlay, planned_outputs, snakemake

import r37
from r37core.results.ranking import robustness
from r37core.results.regions import judged

SPEEDS = [1150, 1550]
SEARCH = {
    "blade": "Ref",
    "variables": {"stagger_deg.tip": [-2, 2], "chordwise_sweep_deg": [0, 20]},
    "objectives": {"lined": {"measure": "largest_rms_m", "scenes": ["abradable"]}},
    "constraints": {"first": {"measure": "frequency_hz", "mode": "1B", "at_least_percent": 60}},
    "designs": 3,
    "first": 2,
    "batch": 1,
}
FILES = ("results/search.nc", "results/search.csv")


pytestmark = pytest.mark.usefixtures("warm_calls")


@pytest.fixture(scope="module")
def searched(small_sweep, tmp_path_factory):
    """The small sweep with a search of the workflow that was killed between its designs and has gone on."""
    folder = copy_finished(small_sweep, tmp_path_factory.mktemp("searched") / "sweep")
    changes = {"blades": ["Ref"], "scenes": ["abradable"], "speeds": SPEEDS, "search": SEARCH}
    overlay(folder, "config.yaml", yaml.safe_dump(changes, sort_keys=False))

    def designs():
        return {file: file.stat().st_mtime_ns for file in folder.glob("results/search/*/quantities-*.json")}

    kill_snakemake(folder, *FILES, "--cores", "2", when=designs)
    before = designs()
    assert not (folder / FILES[0]).exists()
    snakemake(folder, *FILES, "--cores", "2")
    assert before.items() < designs().items()
    return folder


@pytest.mark.slow
def test_a_search_is_that_of_the_workflow_and_its_best_design_that_blade(searched, config, caplog):
    """To the last bit, on one core as on two, and without a break."""
    assert planned_outputs(searched, *FILES) == {}
    assert "search_designs" in planned_outputs(searched, *FILES, "--config", "search={designs: 4}")
    results = r37.open_results(searched / "results")
    with caplog.at_level("INFO", "r37"):
        again = r37.run("Ref", "abradable", SPEEDS, search=SEARCH, config=config)
    xr.testing.assert_identical(again["search"], results["search"])
    pd.testing.assert_frame_equal(again.tables["search"], results.tables["search"])
    told = [message for message in caplog.messages if message.startswith("search: ")]
    assert len(told) == 3 and told[0] == "search: round 0, 2 designs"
    assert re.match(r"search: round 1, 1 design; 2 tried: best d000\d, lined ", told[1])
    best = again["search"].isel(design=again["search"].order.values == 1)
    name, value = str(best.design.item()), float(best.objective_value.item())
    assert told[-1] == f"search: the last round is done; 3 tried: best {name}, lined {value:.4g} m"
    better = r37.blade("Ref", name="Better", config=config, **again.best_values())
    response = r37.sweep(better, "abradable", SPEEDS, config=config)
    assert robustness(judged(response))["largest_rms_m"] == value


@pytest.mark.slow
def test_designs_that_cannot_be_built_are_results(config, caplog):
    turned = {**SEARCH, "variables": {"thickness_percent": [900, 1000]}}
    with caplog.at_level("INFO", "r37"):
        results = r37.run("Ref", "abradable", SPEEDS, search={**turned, "first": 3}, config=config)
    refused = results.tables["search"].refused.tolist()[1:]
    assert len(refused) == 3 and all("no pressure-side arc" in reason for reason in refused)
    assert np.isfinite(results["search"].objective_value.sel(design="start")).all()
    none = "3 tried, 3 of them cannot be built: none can be built and keeps all constraints"
    assert f"search: the last round is done; {none}" in caplog.messages
    with pytest.raises(ValueError, match="keeps all constraints; the table search has what each gave"):
        results.best_values()


@pytest.mark.slow
def test_a_design_of_a_scene_is_that_scene(config):
    """The best design and a sweep in its scene give the same to the last bit, and another number than the start."""
    lined = {"lined": {"measure": "largest_rms_m", "scenes": ["abradable"]}}
    search = {"blade": "Ref", "variables": {"scene.lining.thickness_m": [2e-5, 2e-4]}, "objectives": lined}
    search |= {"designs": 3, "first": 2, "batch": 1}
    results = r37.run("Ref", "abradable", SPEEDS, search=search, config=config)
    assert results.best_values() == {}
    scene = r37.scene("abradable", name="thin", config=config, **results.best_scene_values())
    search = results["search"]
    value = float(search["objective_value"].values[search["order"].values == 1].item())
    assert robustness(judged(r37.sweep("Ref", scene, SPEEDS, config=config)))["largest_rms_m"] == value
    assert value != pytest.approx(search["objective_value"].sel(design="start").item(), rel=1e-3)


@pytest.mark.parametrize(("kind", "changes", "message"), refusal_rows(Path(__file__).with_name("refusals.txt"), "searches"))
def test_what_cannot_be_searched_is_told(config, kind, changes, message):
    with pytest.raises(r37.ConfigError, match=pattern_of(message)):
        r37.run("Ref", "abradable", SPEEDS, search={**SEARCH, **yaml.safe_load(changes)}, config=config)


def test_the_missing_package_is_named_in_one_line(config, monkeypatch):
    monkeypatch.setitem(sys.modules, "sklearn.gaussian_process", None)
    with pytest.raises(r37.ConfigError) as refused:
        r37.run("Ref", "abradable", SPEEDS, search=SEARCH, config=config)
    assert re.fullmatch(r"r37.run: search: .* extra package scikit-learn: pip install -e '\.\[search\]' .*", str(refused.value))
