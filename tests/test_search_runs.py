"""A search through Snakemake: its designs are ordinary jobs, it goes on after a kill, and the same designs come of it."""

import json

import pytest
from stubbed_runs import copy_stubbed, simulated
from workflow_runs import copy_finished, kill_snakemake, overlay, planned_outputs, snakemake

from r37core.product.leftovers import leftovers
from r37core.product.reading import read_settings

pytestmark = pytest.mark.slow

SEARCH = """
search:
  blade: CS100
  variables: { stagger_deg.tip: [-3, 3], thickness_percent: [90, 110] }
  objectives: { lined: { scenes: [abradable] } }
  designs: 4
  first: 2
  batch: 1
  method: quasi_random
"""


@pytest.fixture(scope="module")
def first_run(root, tmp_path_factory):
    """A finished stubbed search, and what Snakemake said."""
    folder = tmp_path_factory.mktemp("search")
    copy_stubbed(root, folder)
    overlay(folder, "config.yaml", SEARCH)
    return folder, snakemake(folder, "search", "--cores", "2")


@pytest.fixture
def project(first_run, tmp_path):
    return copy_finished(first_run[0], tmp_path / "project")


def designs_of(folder):
    """Name -> values of all designs, in the order of the rounds."""
    files = sorted(folder.glob("results/search/round_*.json"))
    return {name: tuple(of) for file in files for name, of in json.loads(file.read_text())["new"].items()}


def test_designs_are_ordinary_jobs_and_one_that_cannot_be_built_asks_for_no_model(first_run):
    folder, text = first_run
    designs = designs_of(folder)
    assert list(designs) == ["d0000", "d0001", "d0002", "d0003"]
    done = simulated(text)
    # not d0001, and none of the other scene
    expected = {f"search/{name}/CS100/abradable" for name in ("start", "d0000", "d0002", "d0003")}
    assert {file.rpartition("/")[0] for file in done} == expected and len(done) == len(set(done))
    last = json.loads((folder / "results/search/round_3.json").read_text())
    assert last["tried"]["d0001"]["refused"] == "it folds" and last["tried"]["d0003"]["quantities"] == {"lined": [3.0, None]}
    assert planned_outputs(folder, "search") == {}
    assert leftovers(folder / "results", read_settings(folder)) == []


def test_a_killed_search_goes_on_with_the_same_designs(first_run, root, tmp_path):
    copy_stubbed(root, tmp_path)
    overlay(tmp_path, "config.yaml", SEARCH)
    begun = tmp_path / "results/search/d0002/CS100/abradable"
    kill_snakemake(tmp_path, "search", "--cores", "1", when=begun.exists)
    assert not (tmp_path / "results/search.nc").exists()
    snakemake(tmp_path, "search", "--cores", "1", "--rerun-incomplete")
    assert designs_of(tmp_path) == designs_of(first_run[0])


def test_more_designs_make_only_the_new_ones(project):
    before = designs_of(project)
    overlay(project, "config.yaml", "search: { designs: 5 }")
    done = simulated(snakemake(project, "search", "--cores", "2"))
    assert {file.rpartition("/")[0] for file in done} == {"search/d0004/CS100/abradable"}
    assert {name: values for name, values in designs_of(project).items() if name in before} == before


def test_other_bounds_make_other_designs_and_nothing_stays_of_the_old(project):
    before = designs_of(project)
    overlay(project, "config.yaml", "search: { variables: { stagger_deg.tip: [-2, 2] } }")
    snakemake(project, "search", "--cores", "2")
    designs = designs_of(project)
    assert designs["d0000"] != before["d0000"] and max(abs(values[0]) for values in designs.values()) <= 2.0
    assert planned_outputs(project, "search") == {}


def test_without_its_section_a_search_is_left_over(project):
    settings = read_settings(project)
    assert settings.config.search
    (project / "config/config.yaml").write_text((project / "config/config.yaml").read_text().split("search:")[0])
    left = {file.relative_to(project / "results").as_posix() for file in leftovers(project / "results", read_settings(project))}
    assert {"search.nc", "search.csv", "search/d0000", "search/start", "search/round_0.json"} <= left
