"""A search as its job does it, with fakes for models and simulations; and searches whose variables are of scenes, too."""

import math
import pickle
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from test_search import BLADES, SEARCH, campbell, folder  # noqa: F401
from workflow_runs import overlay

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import Named
from r37core.plans.extent import Runs
from r37core.product.extensions import read_settings
from r37core.rom.rotation import BucklingError
from r37core.stress.operator import StressOperator
from r37core.sweep import recipe
from r37core.sweep.driver import one_by_one
from r37core.sweep.recipe import Recipe, recipes
from r37studies.search import evaluation, steps
from r37studies.search.designs import designs_of
from r37studies.search.evaluation import Evaluation
from r37studies.search.plan import Search, simulations

FILE = Recipe.file


class Simulated(list):
    """Designs and scenes that were simulated, in their order. `lengths` by scene, else the number of the design."""

    def __init__(self):
        self.lengths, self.breaks_at, self.error = {}, "", KeyboardInterrupt()


@pytest.fixture
def simulated(tmp_path, monkeypatch):
    """The stress by rotation alone grows with the square of the speed, for nothing stiffens. The second design is refused."""
    done = Simulated()
    write_dataset(xr.Dataset({"volume": 2.0}), tmp_path / "geometry.nc")
    write_dataset(campbell(), tmp_path / "campbell.nc")
    operator = np.zeros((6, 1, 2))
    operator[0, 0] = 7.0, 1.0

    class Driver:
        def __init__(self, folder, *_):
            self.folder = folder

        def run(self, sweeps, *_):
            *_, design, scene = self.folder.parts
            if design == done.breaks_at:
                raise done.error
            done.append(f"{design}/{scene}")
            return {member: done.lengths.get(scene, float(design.strip("dstar") or 0)) for member in sweeps}

    def file(self, *_):
        if "search/d0001" in str(self.params):
            raise ValueError("crossed")
        return tmp_path / self.name

    def robustness(length, operating=None):
        return {"exceedance_integral_rad_s": length, "exceedance_integral_scatter_rad_s": 0.5}

    monkeypatch.setattr(evaluation, "Driver", Driver)
    monkeypatch.setattr(Recipe, "file", file)
    monkeypatch.setattr(evaluation, "read_judged", lambda length: length)
    monkeypatch.setattr(evaluation, "robustness", robustness)
    monkeypatch.setattr(evaluation, "read_contact_model", lambda file: Named(rotation_stiffening=np.zeros(1)))
    monkeypatch.setattr(evaluation, "read_stress_operators", lambda file: {"one": StressOperator(operator, 1, "")})
    return done


def quantities(folder, designs):
    return Evaluation(read_settings(folder), folder / "search", one_by_one, 1).quantities(designs)


def search(folder, name="search"):
    """Do the search of a folder; its dataset and table."""
    settings, files = read_settings(folder), folder / name
    plan = Search(settings)
    params = {"carried": plan.carried(None), "budget": plan.budget(None), "fidelity": "draft", "cores": 1}
    output = Named(dataset=files / "search.nc", table=files / "search.csv")
    steps.search(Named(), output, Named(**params))
    return read_dataset(output.dataset), pd.read_csv(output.table, index_col="design")


def test_a_design_is_measured_by_its_structure_and_by_all_its_runs(folder, simulated):
    """Once. Nothing is known of the bare scene."""
    objectives = """
      lined: { scenes: [abradable] }
      lost: { scenes: [direct] }
      mass: { measure: mass_kg }
      still: { measure: static_stress_pa }
      slow: { measure: static_stress_pa, speed_rad_s: 500 }
      flap: { measure: frequency_hz, mode: 1B, speed_rad_s: 500 }"""
    overlay(folder, "config.yaml", f"search:\n    objectives:{objectives}")
    simulated.lengths |= {"abradable": 3.0, "direct": math.nan}
    (measured,) = quantities(folder, {"start": None})
    assert quantities(folder, {"start": None}) == [measured] and simulated == ["start/abradable", "start/direct"]
    assert measured == {
        "lined": [3.0, 0.5], "lost": [None, 0.5], "mass": [16000.0, 0.0], "still": [4e6, 0.0], "slow": [2.5e5, 0.0],
        "flap": [120.0, 0.0],
    }  # fmt: skip


def test_a_design_that_cannot_be_built_is_a_result(folder, simulated, monkeypatch):
    """One that is no blade, and one of an impossible shape; the start raises."""
    monkeypatch.setattr(Recipe, "file", FILE)
    overlay(folder, "config.yaml", "search: { variables: { thickness_percent: [900, 1000] } }")
    refused = quantities(folder, {"d0001": (0.5, 1.0, 950.0), "d0002": (0.0, 89.0, 100.0)})
    assert "no pressure-side arc" in refused[0] and "stagger_deg" in refused[1] and not simulated


def test_a_design_that_buckles_is_a_result(folder, simulated):
    simulated.breaks_at, simulated.error = "d0002", BucklingError(1500.0)
    refused, built = quantities(folder, {"d0002": (0.5, 1.0), "d0003": (0.6, 1.0)})
    assert "no stable position at 1500 rad/s" in refused and built == {"lined": [3.0, 0.5]}


def test_designs_are_measured_again_by_other_code_of_their_structure(folder, simulated, monkeypatch):
    quantities(folder, {"start": None})
    code_of = recipe.code_of
    monkeypatch.setattr(
        recipe, "code_of", lambda step, *more: "another" if step == "r37core.fem.steps.mesh" else code_of(step, *more)
    )
    quantities(folder, {"start": None})
    assert simulated == ["start/abradable", "start/abradable"]


def test_a_search_gives_all_designs(folder, simulated):
    dataset, rows = search(folder)
    names = [f"d000{number}" for number in range(5)]
    assert list(rows.index) == ["start", *names] and rows.loc["d0001", "refused"] == "crossed"
    assert simulated == [f"{name}/abradable" for name in ["start", *names] if name != "d0001"]
    assert dataset.attrs["fidelity"] == "draft" and len(dataset.attrs["input_hash"]) > 8
    assert rows["order"].tolist() == [0, 1, 0, 2, 3, 4]


def test_a_broken_search_goes_on_with_the_same_designs(folder, simulated):
    whole, _ = search(folder, "whole")
    expected, simulated[:] = list(simulated), []
    simulated.breaks_at = "d0003"
    with pytest.raises(KeyboardInterrupt):
        search(folder)
    assert simulated == expected[:3]
    simulated.breaks_at = ""
    again, _ = search(folder)
    assert simulated == expected
    xr.testing.assert_identical(again, whole)


def test_more_designs_run_alone_and_other_bounds_make_other_designs(folder, simulated):
    overlay(folder, "config.yaml", "search: { designs: 5, first: 5 }")
    before, _ = search(folder)
    simulated.clear()
    overlay(folder, "config.yaml", "search: { designs: 6, first: 6 }")
    more, _ = search(folder)
    assert simulated == ["d0005/abradable"]
    xr.testing.assert_equal(more["value"].isel(design=slice(6)), before["value"])
    overlay(folder, "config.yaml", "search: { variables: { stagger_deg.tip: [-2, 2] } }")
    other, _ = search(folder)
    assert simulated[1:] == [f"d000{number}/abradable" for number in (0, 2, 3, 4, 5)]
    tips = other["value"].sel(variable="stagger_deg.tip")[1:]
    assert abs(tips).max() <= 2.0 and tips[0] != more["value"].sel(design="d0000", variable="stagger_deg.tip")


def test_the_plan_of_a_search(folder):
    """Its rounds, and settings that a job of its own has, too."""
    overlay(folder, "config.yaml", "search: { designs: 7, first: 3 }")
    settings = read_settings(folder)
    plan = Search(settings)
    assert plan.budget(None) == [3, 2, 2] and simulations(settings) == {("Free", "abradable"): Runs(8 * 3, 8 * 3, models=7)}
    carried = pickle.loads(pickle.dumps(plan.carried(None))).settings
    assert Search(carried).made_of(None) == plan.made_of(None)


SCENES_ALONE = "scene.lining.thickness_m: [0.001, 0.004], scene.friction.coefficient: [0.05, 0.2]"
BOTH_SCENES = "objectives: { lined: { scenes: [abradable] }, bare: { scenes: [direct] } }"


def searched_settings(folder, variables, changes=""):
    """Settings of a search with these variables."""
    overlay(folder, "blades.yaml", BLADES)
    overlay(folder, "config.yaml", SEARCH)
    file = folder / "config/config.yaml"
    content = yaml.safe_load(file.read_text())
    content["search"] |= yaml.safe_load(f"{{ variables: {{ {variables} }}, {BOTH_SCENES} {changes} }}")
    file.write_text(yaml.safe_dump(content, sort_keys=False))
    return read_settings(folder)


def runs_of(settings, name, values):
    return Evaluation(settings, Path(), one_by_one, 1).runs(name, values)


def test_a_variable_of_scenes_changes_every_scene_that_has_it_and_no_model(config_copy, simulated):
    """The shape of such a design is not meshed, and cannot be refused but by its scene."""
    settings = searched_settings(config_copy, SCENES_ALONE)
    designs = designs_of(settings)
    assert designs.start_values == [0.005, 0.15] and not designs.change_blade
    nominal = recipes(settings, "Free", {"contact_model": None})["contact_model"]
    for name, values, thickness, friction in (("start", None, 0.005, 0.15), ("d0001", (0.002, 0.1), 0.002, 0.1)):
        lined, bare = (of.scenes[scene].scene for scene, of in designs.design_settings(name, values).items())
        assert lined.lining.thickness == thickness and bare.lining is None
        assert lined.friction.coefficient == bare.friction.coefficient == friction
        runs = runs_of(settings, name, values)
        assert runs.structure["contact_model"] == nominal
        assert all(sweep.recipes["contact_model"] == nominal for sweep in runs.scenes.values())
    assert isinstance(quantities(config_copy, {"d0001": (0.002, 0.1)})[0], dict)
