"""The studies: their numbers by hand, and small real runs of their rules."""

import json

import pytest
from workflow_runs import snakemake

from r37core.studies.estimate import describe, project_costs
from r37core.studies.sampling import sample


def test_sample_stands_for_the_whole_range():
    speeds = [float(speed) for speed in range(750, 2001)]
    chosen = sample(speeds, 50)
    assert len(chosen) == 25
    assert sum(chosen) / len(chosen) == pytest.approx(sum(speeds) / len(speeds), abs=1.0)
    assert sample([3.0, 4.0], 50) == [4.0]


def test_projection_by_hand():
    samples = [{"march": 10.0, "reduction": 1.0, "runs": 4}, {"march": 30.0, "reduction": 2.0, "runs": 6}]
    estimate = project_costs(samples, start_up=0.1, workflow_per_job=0.05, cores=2)
    assert estimate["total"] == pytest.approx(40.0 + 3.0 + 10 * 0.15)
    assert estimate["wall"] == pytest.approx(estimate["total"] / 2)
    assert "10 simulations" in describe(estimate, "paper")
    assert "| march | 0.01 | 4.000 |" in describe(estimate, "paper")


def test_estimate_of_a_small_sweep(project):
    snakemake(project, "estimate", "--cores", "2")
    estimate = json.loads((project / "results/studies/estimate.json").read_text())
    assert estimate["runs"] == 12
    assert 0.0 < estimate["march"] < 60.0
    assert 0.01 < estimate["start-up"] / 12 < 2.0
    assert (project / "results/studies/estimate.md").read_text().startswith("Level `tiny`: 12 simulations")
