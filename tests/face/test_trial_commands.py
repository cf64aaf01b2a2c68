"""Commands of trials, and calls that count their simulations."""

import re

import pytest
from workflow_runs import copy_project, overlay, snakemake

import r37
from r37.command import main
from r37core.config import command_line_document, read_document
from r37core.plans import extent
from r37core.plans.extent import fixed_seconds, number_of, simulation_seconds
from r37core.product.extensions import read_settings, whole_extent
from r37core.results.table_file import read_table
from r37studies.requirements import plan
from r37studies.trials import estimate

FURTHER = """
blades: [Ref]
scenes: [abradable]
speeds: [{ start: 1000, stop: 1500, step: 20, refine_to: 1 }]
tolerances: { members: 4, of_scenes: { friction.coefficient: { uniform_percent: 5 } } }
second_motions: { from_rad_s: 1000, to_rad_s: 1400, step_rad_s: 100 }
run_ups: { up: { from_rad_s: 1000, to_rad_s: 1400, revolutions: 350, revolutions_before: 30, revolutions_after: 20 } }
operating: { idle_rad_s: 1000, redline_rad_s: 1500 }
requirements: { above_yield_at_most_rad_s: 0 }
"""


def test_all_further_runs_are_counted_and_cost_what_they_are_long(root, tmp_path, capsys):
    """By hand. The estimate and the check have the same; what results ask for is a range, and nothing else is."""
    (file := tmp_path / "further.yaml").write_text(FURTHER)
    settings = read_settings(root, read_document(tmp_path, "further.yaml"))
    whole, pair = whole_extent(settings), ("Ref", "abradable")
    assert number_of(whole) == 100 + 400 + 11 + round(plan._LOOKED * 664 + 6)
    assert {name: (runs[pair].fewest, runs[pair].number) for name, runs in whole.items()} == {
        "sweep": (26, 100),
        "tolerances": (4 * 26, 4 * 100),
        # up, down, and from rest, of which the sweep has all
        "second_motions": (None, 10),
        "run_ups": (None, 1),
        # up and down at three rates
        "requirements": (0, plan._LOOKED * (200 + 200 + 264) + 6),
    }
    assert whole["second_motions"][pair].length == 10
    assert whole["run_ups"][pair].length == pytest.approx(400 / 200)
    run_ups = 2 * (300 + 700 + 2700)
    assert whole["requirements"][pair].length == pytest.approx(plan._LOOKED * 664 + run_ups / 200)
    runs = estimate.values(settings, whole)["runs"]
    assert number_of(whole) == round(sum(number for several in runs.values() for number, _ in several.values()))
    assert main(["check", str(root / "config/config.yaml"), str(file)]) == 0
    told = capsys.readouterr().out
    assert "simulations: sweep about 100, as results ask (26 at least), " in told
    assert ", run_ups 1, second_motions 10, " in told and "at most" not in told
    lengths = 100 + 400 + whole["requirements"][pair].length + whole["second_motions"][pair].length + 2
    seconds = fixed_seconds(settings, whole) + lengths * simulation_seconds(settings, pair) + 100 * extent.JOB_S
    assert f"CPU time: about {seconds / 60:.1f} minutes" in told


def test_time_is_that_of_the_steps_of_all_runs(root):
    """A longer run, more blades on a lining and more models cost more, each by its own amount."""

    def seconds(**changes):
        settings = read_settings(root, command_line_document({"blades": ["Ref"], "speeds": [1000, 1500], **changes}))
        return fixed_seconds(settings, whole_extent(settings)), simulation_seconds(settings, ("Ref", changes["scenes"][0]))

    (fixed, one), (_, rotor) = seconds(scenes=["abradable"]), seconds(scenes=["rotor_abradable"])
    assert 20 * one < rotor < 36 * one
    assert seconds(scenes=["abradable"], fidelity="paper")[1] > 10 * one
    coarse, _ = seconds(scenes=["abradable"], fidelity="draft")
    assert fixed - coarse == pytest.approx(15000 * extent._NODE_S)


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
        "{ blades: [Ref], scenes: [direct], tradeoff: { parameters: [friction_form] }, "
        "stability: { extremes: [damping_ratio] } }",
    )
    said = snakemake(project, "tradeoff", "stability", "estimate", "--cores", "2")
    tradeoff, extremes, costs = (
        read_table(project / f"results/{preset}.csv") for preset in ("tradeoff", "stability", "estimate")
    )
    constant = tradeoff.set_index(["what", "value"]).loc[("friction_form", "constant")]
    assert constant["error_rms_normal"] == 0.0 < min(constant["cpu_s"], constant["model_cpu_s"], constant["rms_m"])

    assert "stability: 4 variations: " in said and "1 refused" in said
    assert len(extremes) == 4 and "unsound" not in set(extremes["outcome"])

    assert re.search(r"estimate: about \d+ simulations, ", said)
    parts = costs.set_index("part")
    minutes, simulations = parts["core_min"], parts["simulations"]["time integration"]
    assert 0.0 < 60.0 * minutes["time integration"] / simulations < 2.0
    assert minutes["total"] == pytest.approx(minutes[:-1].sum(), rel=1e-3)
