"""Commands of trials, and calls that count their simulations."""

import re

import pytest
from workflow_runs import copy_project, overlay, snakemake

import r37
from r37.command import main
from r37core.config import read_document
from r37core.plans.extent import extent_of
from r37core.product.extensions import read_settings, simulations_of_members
from r37core.results.table_file import read_table
from r37studies.trials import estimate


def test_the_estimate_and_the_check_count_the_same_simulations(root, tmp_path, capsys):
    """Those of members, too."""
    ranges = "of_scenes: { friction.coefficient: { uniform_percent: 5 } }"
    (file := tmp_path / "members.yaml").write_text(f"tolerances: {{ members: 4, {ranges} }}\n")
    settings = read_settings(root, read_document(tmp_path, "members.yaml"))
    members = simulations_of_members(settings)
    whole, runs = extent_of(settings, members), estimate.values(settings, members)["runs"]
    assert sum(runs.values()) == whole.at_most == whole.most + whole.members > whole.most > whole.certain
    assert main(["check", str(root / "config/config.yaml"), str(file)]) == 0
    told, cost = capsys.readouterr().out, whole.cpu_time(settings.fidelity.measured.cpu_s_per_run)
    assert f"simulations: {whole.certain} to about {whole.most}, and at most {whole.members} of members\n" in told
    assert f"CPU time: about {cost} at most" in told


def test_python_makes_what_a_section_asks_for(monkeypatch, root):
    """Without a target the tables; the section of an extension that is made on request adds its own."""
    asked = []
    monkeypatch.setattr("r37.runs.run_workflow", lambda settings, place, targets, cores: asked.append(list(targets)))
    for more in ({"estimate": {"every": 600}}, {"tolerances": {}}, {"tradeoff": {}, "targets": "stability"}):
        r37.run("Ref", "direct", [900], config=root / "config/config.yaml", **more)
    assert asked == [["tables", "estimate"], ["tables"], ["stability"]]


@pytest.mark.slow
def test_all_presets(root, tmp_path):
    copy_project(root, project := tmp_path / "project")
    overlay(
        project,
        "config.yaml",
        "{ blades: [Ref], tradeoff: { scenes: [abradable], parameters: [friction_form] }, "
        "stability: { scenes: [direct], extremes: [damping_ratio] } }",
    )
    said = snakemake(project, "tradeoff", "stability", "estimate", "--cores", "2")
    tradeoff, extremes, costs = (
        read_table(project / f"results/{preset}.csv") for preset in ("tradeoff", "stability", "estimate")
    )
    constant = tradeoff.set_index(["what", "value"]).loc[("friction_form", "constant")]
    assert constant["error_rms_normal"] == 0.0 < min(constant["cpu_s"], constant["model_cpu_s"], constant["rms_m"])

    assert "stability: 4 variations: " in said and "1 refused" in said
    assert len(extremes) == 4 and "unsound" not in set(extremes["outcome"])

    assert re.search(r"estimate: \d+ simulations at most, ", said)
    per_run = costs.set_index("part")["core_s_per_simulation"]
    assert per_run["time integration"] > 0.0 and 0.01 < per_run["start-up"] < 2.0
