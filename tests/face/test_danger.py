"""One measure of danger: all that shows how dangerous a run is says the same of it, in region, number and word."""

import re
import shutil
import time
from pathlib import Path

import numpy as np
import pytest
import yaml
from workflow_runs import copy_project, overlay, snakemake

import r37
from r37core.base.dataset_file import read_dataset
from r37core.base.yaml_file import load_yaml
from r37core.figures.comparison import draw_ranking
from r37core.figures.fatigue_map import draw_fatigue_map
from r37core.figures.interaction_map import draw_interactions
from r37core.figures.response_curves import draw_response
from r37core.product.closing import closing_lines
from r37core.results.columns import DANGER, names
from r37core.results.danger import danger_of
from r37core.results.datasets import FURTHER_RUNS, response_of
from r37core.results.interactions import sized
from r37core.results.regions import read_judged

pytestmark = pytest.mark.slow

PAIRS = [(blade, scene) for blade in ("Open", "Heavy", "Fan") for scene in ("Stage", "Bare")]


def fan_cases(root):
    """Blades and scenes: an open variant of rotor 37, above yield in some revolutions; a heavier one, which ties; a fan."""
    (fan,), (stage, *_) = (load_yaml(root / f"examples/fan/{name}.yaml").values() for name in ("blades", "scenes"))
    steel = {"youngs_modulus_pa": 180e9, "poissons_ratio": 0.3, "yield_stress_pa": 1.38e9}
    steel |= {"fatigue_strength_pa": 4e8, "ultimate_strength_pa": 1.5e9}
    variant = {"sections": "open_variant.csv", "length_unit": "m", "rotor_axis": [0, 0, 1], "radial": [0, 1, 0]}
    variant |= {"rotation": "negative", "hub": {"cone_zr_m": [[0.0, 0.17993], [0.04341, 0.18965]]}}
    variant |= {"tip": {"cone_zr_m": [[0.00729, 0.25533], [0.03431, 0.24794]]}}
    blades = {
        name: variant | {"material": steel | {"density_kg_m3": density}} for name, density in (("Open", 8e3), ("Heavy", 8.1e3))
    }
    bare = {key: value for key, value in stage.items() if key != "lining"}
    bare["results"] = ["spectrum", "stress", "static_stress", "fatigue"]
    return blades | {"Fan": fan | {"mesh": "fan.msh"}}, {"Stage": stage, "Bare": bare}


@pytest.fixture(scope="module")
def results(root, tmp_path_factory):
    """A finished run of three blades in two scenes, with a verdict."""
    folder = tmp_path_factory.mktemp("danger")
    copy_project(root, folder)
    blades, scenes = fan_cases(root)
    (folder / "config/blades.yaml").write_text(yaml.safe_dump(blades))
    (folder / "config/scenes.yaml").write_text(yaml.safe_dump(scenes))
    shutil.copy(Path(__file__).parents[1] / "cases" / "open_variant.csv", folder)
    shutil.copy(root / "examples/fan/fan.msh", folder)
    run = {"blades": list(blades), "scenes": list(scenes), "fidelity": "draft", "speeds": [490, 1620, 1640, 1660]}
    run |= {"operating": {"idle_rad_s": 1620, "redline_rad_s": 1660}}
    # each blade fails by one of them, which needs few further runs
    run |= {"requirements": {"above_yield_at_most_rad_s": 0, "goodman_share_at_most": 0.2}}
    overlay(folder, "config.yaml", yaml.safe_dump(run))
    snakemake(folder, "tables", "--cores", "2")
    return folder / "results"


@pytest.fixture(scope="module")
def datasets(results):
    kinds = ("campbell", "rms", "stress", "fatigue", "wear", "spectrum", FURTHER_RUNS)
    return {kind: read_judged(results / f"{kind}.nc") for kind in kinds if (results / f"{kind}.nc").exists()}


@pytest.fixture(scope="module")
def tables(results):
    return {name: r37.open_results(results).tables[name] for name in ("summary", "ranking", "verdict")}


@pytest.fixture(scope="module")
def dangers(datasets):
    """Blade and scene -> its danger, from its runs."""
    return {pair: danger_of(response_of(datasets, *pair)) for pair in PAIRS}


def of(table, pair):
    return table[(table["blade"] == pair[0]) & (table["scene"] == pair[1])]


def test_the_run_has_what_pictures_were_wrong_about(dangers):
    """Above yield in some revolutions alone, four times yield at most; in half of them; and without any length."""
    assert dangers["Open", "Stage"]["length_most_revolutions_rad_s"] == 0.0 < dangers["Open", "Stage"]["length_dangerous_rad_s"]
    assert {danger["length_unknown_rad_s"] > 0.0 for danger in dangers.values()} == {True, False}


@pytest.mark.parametrize("pair", PAIRS)
def test_tables_verdict_and_python_have_the_danger_of_the_runs(results, datasets, tables, dangers, pair):
    danger, response = dangers[pair], response_of(datasets, *pair)
    (ranked,) = of(tables["ranking"], pair).to_dict("records")
    assert {name: ranked[name] for name in names(DANGER)} == pytest.approx(danger, rel=1e-4, nan_ok=True)
    rows = of(tables["summary"], pair)
    for name in ("share_of_revolutions_above_yield", "largest_stress_pa"):
        if danger["share_of_revolutions_above_yield"] > 0.0:
            assert rows[name].max() == pytest.approx(danger[name], rel=1e-5), name
    verdict = of(tables["verdict"], pair).set_index("requirement")
    assert verdict.loc["above_yield", "value"] == pytest.approx(ranked["length_dangerous_operating_rad_s"], rel=1e-5)
    inside = response.sel(speed=slice(1620.0, 1660.0))
    assert verdict.loc["goodman_share", "value"] == pytest.approx(float(inside["goodman_share_inside"].max()), rel=1e-5)
    ours = r37.open_results(results).response(*pair).isel(region=0)
    # without the further runs of the verdict
    sweep = response_of({kind: dataset for kind, dataset in datasets.items() if kind != FURTHER_RUNS}, *pair)
    np.testing.assert_array_equal(ours["max_von_mises_ever"], sweep["max_von_mises_ever"])
    assert str(ours["stress_region"].values) == rows["stress_region"].iloc[0] if len(rows) else True


def test_the_last_lines_have_the_words_and_the_numbers(results, tables):
    first, *lines = closing_lines(results, 0.0, time.time())
    summary = tables["summary"]
    worst = summary.loc[summary["largest_stress_over_yield"].idxmax()]
    for said in (
        f"{np.count_nonzero(summary['length_dangerous_rad_s'] > 0.0)} of them dangerous",
        f"{worst['largest_stress_over_yield']:.3g} times yield before the model is left, {worst['blade']} in {worst['scene']}",
    ):
        assert said in first
    assert any("Bare: Open, Heavy and Fan cannot be ranked" in line for line in lines)
    assert of(tables["ranking"], ("Open", "Bare"))["rank"].item() == of(tables["ranking"], ("Heavy", "Bare"))["rank"].item()


@pytest.mark.parametrize("blade", ["Open", "Fan"])
def test_the_response_reaches_to_the_largest_stress_of_the_region_that_decides(datasets, blade):
    drawn = {kind: datasets[kind].sel(blade=blade) for kind in ("campbell", "rms", "stress")}
    *_, axes = draw_response(blade, *drawn.values()).axes[:3]
    for scene in ("Stage", "Bare"):
        stress = drawn["stress"].sel(scene=scene)
        for name in ("max_von_mises_inside", "max_von_mises_ever"):
            assert any(
                np.allclose(line.get_ydata(), 1e-9 * stress[name]) for line in axes.lines if len(line.get_ydata()) == 4
            ), name
    assert str(drawn["stress"]["stress_region"].values.flat[0]).split(",")[0] in axes.get_ylabel().replace("\n", " ")


@pytest.mark.parametrize("pair", [("Open", "Stage"), ("Fan", "Bare")])
def test_the_map_has_the_share_and_the_region_of_the_verdict(results, datasets, tables, pair):
    folder = results / pair[0]
    response = read_dataset(folder / pair[1] / "response.nc")
    further = datasets[FURTHER_RUNS].sel(blade=pair[0], scene=pair[1]) if FURTHER_RUNS in datasets else None
    files = folder / "mesh.vtu", folder / "rom_pressure_edge.nc"
    title = draw_fatigue_map(*files, read_judged(folder / pair[1] / "response.nc"), "map", further)
    # that of a further run of the verdict stands in the title, too
    found = max(map(float, re.findall(r"(?:largest share|verdict has) ([\d.]+)", title.get_suptitle())))
    assert found == pytest.approx(of(tables["ranking"], pair)["largest_goodman_share"].item(), rel=1e-2)
    assert str(response["stress_region"].values[0]) in title.get_suptitle()


def test_marks_of_the_interactions_are_those_of_the_table(datasets, tables):
    """No row that was ever above yield has the mark of none."""
    summary = tables["summary"]
    marks = sized(summary, datasets["rms"])["danger"]
    assert (marks == "dangerous").tolist() == (summary["length_dangerous_rad_s"] > 0.0).tolist()
    figure = draw_interactions(datasets["campbell"], datasets["rms"], summary, datasets["stress"], datasets.get(FURTHER_RUNS))
    words = {text.get_text() for legend in figure.legends for text in legend.get_texts()}
    assert {"dangerous", "below yield", "sustained"} <= words


def test_the_ranking_s_picture_has_the_ties(tables):
    titles = [axes.get_title() for axes in draw_ranking(tables["ranking"]).axes]
    assert any("Bare" in title for title in titles)
