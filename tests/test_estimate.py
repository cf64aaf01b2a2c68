"""The estimate: a sample of a sweep's runs, and the cost of all of them."""

import pandas as pd
import pytest

from r37.command import main
from r37core.config import command_line_document, read_document
from r37core.estimate import plan
from r37core.estimate.steps import closing, projected_costs
from r37core.plans.extent import extent_of, extents
from r37core.product.extensions import beside
from r37core.product.reading import read_settings


def test_sample_stands_for_the_whole_range():
    speeds = [float(speed) for speed in range(750, 2001)]
    chosen = plan.sample(speeds, 50)
    assert len(chosen) == 25
    assert sum(chosen) / len(chosen) == pytest.approx(sum(speeds) / len(speeds), abs=1.0)
    assert plan.sample([3.0, 4.0], 50) == [4.0]


def test_the_sample_is_of_each_blade_and_scene(root):
    changes = {"blades": ["Ref", "L50"], "scenes": ["abradable", "direct"], "speeds": [900, 1234.5]}
    settings = read_settings(root, command_line_document(changes))
    cases = plan.cases(settings)
    assert list(cases) == ["Ref__abradable", "Ref__direct", "L50__abradable", "L50__direct"]
    assert plan.values(settings, {})["runs"]["Ref__abradable"] == 2
    assert cases["Ref__abradable"].speeds == (1234.5,)


def test_the_estimate_and_the_check_count_the_same_simulations(root, tmp_path, capsys):
    """Those of members, too."""
    ranges = "of_scenes: { friction.coefficient: { uniform_percent: 5 } }"
    (file := tmp_path / "members.yaml").write_text(f"tolerances: {{ members: 4, {ranges} }}\n")
    settings = read_settings(root, read_document(tmp_path, "members.yaml"))
    counted = extents(settings, beside(settings))
    runs = plan.values(settings, beside(settings))["runs"]
    assert runs == {"__".join(place): extent.at_most for place, extent in counted.items()}
    whole = extent_of(settings, beside(settings))
    assert whole.at_most == whole.most + whole.members > whole.most > whole.certain
    assert main(["check", str(root / "config/config.yaml"), str(file)]) == 0
    told, cost = capsys.readouterr().out, whole.at_most * settings.fidelity.measured.cpu_s_per_run
    assert f"simulations: {whole.certain} to about {whole.most}, and at most {whole.members} of members\n" in told
    assert f"CPU time: about {cost / 60.0:.3g} minutes at most" in told


def test_projection_by_hand(tmp_path):
    columns = {"refused": "", "run_cpu_s": [2.5, 5.0], "run_reduction_cpu_s": [0.2, 0.25], "recovery_cpu_s": [0.2, 0.5]}
    cases = pd.DataFrame(columns, index=["Ref__direct", "L50__direct"])
    runs = {"Ref__direct": 4, "L50__direct": 6}
    costs = projected_costs(cases, runs, start_up=0.1, workflow_per_job=0.05, cores=2).set_index("part")
    assert costs.loc["total", "core_hours"] == pytest.approx((40.0 + 3.0 + 10 * 0.15) / 3600.0)
    assert costs.loc["total", "wall_hours"] == pytest.approx(0.5 * costs.loc["total", "core_hours"])
    assert costs.loc["time integration", "core_s_per_simulation"] == 4.0
    costs.reset_index().to_csv(tmp_path / "estimate.csv", index=False)
    assert closing(tmp_path) == "10 simulations at most, 0.01 h on 2 cores"
