"""A project in a folder whose name a shell would take apart; tests/test_workflow.py runs a whole sweep in one."""

import pytest
from workflow_runs import copy_odd_project, run_in_odd_project


@pytest.mark.slow
def test_a_part_of_a_sweep_on_slurm(root, tmp_path):
    """What Slurm would run, without Slurm."""
    folder = copy_odd_project(root, tmp_path)
    slurm = {f"SLURM_{name}": "1" for name in ("CPUS_PER_TASK", "ARRAY_TASK_ID", "ARRAY_TASK_COUNT")}
    slurm["SLURM_SUBMIT_DIR"] = str(folder)
    assert "simulate" in run_in_odd_project(folder, "bash", "cluster/sweep.sbatch", "--dry-run", "--forceall", **slurm)
