"""Jobs of a cluster by an executor of Snakemake's, whose submission is here a shell, and by joblib's backend of the user's."""

import sys

import joblib
import pytest
import yaml
from distributed import Client, LocalCluster
from shared_sweep import copy_structure
from snakemake_interface_executor_plugins.registry import ExecutorPluginRegistry
from workflow_runs import dataset_values, overlay, snakemake

import r37
from r37.jobs import parallel_results
from r37core.config import ConfigError
from r37core.console.executor import Executor

CLUSTER = ("--workflow-profile", "profiles/cluster", "--executor", "cluster-generic", "--cluster-generic-submit-cmd", "sh")
CLUSTER += ("--seconds-between-status-checks", "1")


def test_the_profiles_have_the_keys_of_the_usual_one(root):
    names = ("default", "node", "cluster")
    usual, node, cluster = (yaml.safe_load((root / f"profiles/{name}/config.yaml").read_text()) for name in names)
    assert node == usual | {"cores": "all"}
    assert usual.pop("executor") == "warm"
    assert cluster | usual == cluster


def test_jobs_inside_a_job_of_a_cluster_go_to_the_server(monkeypatch):
    registry = ExecutorPluginRegistry()
    local = registry.get_plugin("local").executor
    monkeypatch.setattr(registry, "plugins", dict(registry.plugins))
    monkeypatch.setattr(Executor, "local", None)
    Executor.replace_local()
    assert registry.get_plugin("local").executor is Executor
    assert Executor.local is local


@pytest.mark.slow
def test_groups_of_a_cluster_give_the_bits_of_one_machine(small_sweep, tmp_path):
    """Adaptive rounds, too: a job of the cluster for each, with all its simulations."""
    adaptive = "{ blades: [CS100], speeds: [{ start: 1000, stop: 1400, step: 100, refine_to: 50 }], scenes: [abradable] }"
    for name in ("alone", "cluster"):
        copy_structure(small_sweep, tmp_path / name)
        overlay(tmp_path / name, "config.yaml", adaptive)
    (tmp_path / "cluster/results/CS100/contact_pressure_edge.npz").unlink()
    snakemake(tmp_path / "alone", "responses", "--cores", "2")
    said = snakemake(tmp_path / "cluster", "responses", "--cores", "2", *CLUSTER)
    runs = len(list((tmp_path / "cluster").glob("results/*/abradable/speed_*.npz")))
    assert 0 < said.count("--local-groupid") < runs / 2
    made = dataset_values(tmp_path / "cluster")
    assert ("results/CS100/abradable/response.nc", "rms_normal") in made
    assert made.items() <= dataset_values(tmp_path / "alone").items()


def test_a_backend_without_results_one_by_one_is_refused():
    with (
        joblib.parallel_config(backend="multiprocessing"),
        pytest.raises(ConfigError, match=r"joblib's backend: .*choose another"),
    ):
        parallel_results([int, int], 2)


@pytest.mark.slow
def test_a_cluster_of_dask_runs_a_call_that_asks_for_cores(config):
    runs = ("Ref", "abradable", [1150, 1550])
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        with joblib.parallel_config(backend="dask"):
            spread = r37.sweep(*runs, config=config, cores=2)
        assert all(client.run(lambda: "r37core.time_integration.speed_job" in sys.modules).values())
    assert spread.identical(r37.sweep(*runs, config=config))
