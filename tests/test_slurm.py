"""A sweep on a real Slurm, of one node, that the test starts: parts, a killed one, and the same bits as without."""

import contextlib
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import time

import numpy as np
import pytest
from workflow_runs import copy_project, dataset_values, overlay, snakemake, wait_until

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue")
MISSING = [program for program in PROGRAMS if not shutil.which(program, path=f"{os.environ['PATH']}:/usr/sbin")]
WANTED = os.environ.get("R37_SLURM")
"""Set by make test-slurm and .ci/run: then what is missing is an error."""

pytestmark = [pytest.mark.slow, pytest.mark.skipif(not WANTED, reason="Slurm and root (make test-slurm, .ci/run)")]

CONFIGURATION = """
ClusterName=r37
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CryptoType=crypto/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,batch_sched_delay=1
ReturnToService=2
MpiDefault=none
KillWait=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=4000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as any_port:
        any_port.bind(("127.0.0.1", 0))
        return any_port.getsockname()[1]


class Slurm:
    """Daemons of a cluster of one node, in a folder of their own."""

    def __init__(self, folder):
        self.folder = folder
        self.environment = os.environ | {"SLURM_CONF": str(folder / "slurm.conf"), "PATH": f"{os.environ['PATH']}:/usr/sbin"}
        for name in ("state", "spool"):
            (folder / name).mkdir()
        key = folder / "munge.key"
        key.write_bytes(np.random.default_rng().bytes(128))
        key.chmod(0o400)
        ports = {"controller": free_port(), "node": free_port()}
        text = CONFIGURATION.format(host=socket.gethostname().split(".")[0], folder=folder, **ports)
        (folder / "slurm.conf").write_text(text)
        files = {"key-file": key, "socket": folder / "munge.socket", "pid-file": folder / "munge.pid"}
        files |= {"log-file": folder / "munge.log", "seed-file": folder / "munge.seed"}
        options = [f"--{option}={file}" for option, file in files.items()]
        commands = (["munged", "--foreground", "--force", *options], ["slurmctld", "-D", "-c"], ["slurmd", "-D", "-c"])
        self.daemons = []
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        for command in commands:
            self.daemons.append(subprocess.Popen(command, env=self.environment, start_new_session=True, **quiet))
            if command[0] == "munged":
                wait_until(files["socket"].exists, 20, "munged")
        wait_until(lambda: "idle" in self.call("sinfo", "--noheader", "--format=%t"), 60, "an idle node")

    def call(self, *command, cwd=None, **environment):
        environment = self.environment | environment
        done = subprocess.run(command, env=environment, cwd=cwd, capture_output=True, text=True, timeout=60, check=False)
        return done.stdout + done.stderr

    def submit(self, project, *options, **environment):
        command = ("sbatch", "--parsable", "--cpus-per-task=1", *options, "cluster/sweep.sbatch")
        environment |= {"R37_PYTHON": sys.executable, "PYTHONPATH": str(project / "src")}
        said = self.call(*command, cwd=project, **environment).strip()
        assert said.isdigit(), said
        return said

    def waiting(self, job):
        """States of the tasks of a job that are not over."""
        return self.call("squeue", "--noheader", "--format=%t", f"--jobs={job}").split()

    def stop(self):
        for daemon in reversed(self.daemons):
            with contextlib.suppress(ProcessLookupError):
                os.killpg(daemon.pid, signal.SIGTERM)
            daemon.wait(timeout=30)


@pytest.fixture
def slurm(tmp_path_factory):
    assert not MISSING, f"missing: {', '.join(MISSING)}; on Debian: apt-get install slurmctld slurmd slurm-client munge"
    folder = tmp_path_factory.mktemp("slurm")
    folder.chmod(0o755)
    cluster = Slurm(folder)
    yield cluster
    cluster.stop()


def project(root, folder):
    copy_project(root, folder)
    shutil.copytree(root / "cluster", folder / "cluster")
    overlay(folder, "config.yaml", "{ speeds: [{ start: 1000, stop: 1400, step: 100, refine_to: 12.5 }], scenes: [abradable] }")
    return folder


def test_parts_on_slurm_one_of_them_killed_give_the_bits_of_one_run(root, compiled, tmp_path, slurm):
    alone = project(root, tmp_path / "alone")
    snakemake(alone, "all_blades", "--cores", "2")

    parts = project(root, tmp_path / "parts")
    job = slurm.submit(parts, "--array=1-2")
    wait_until(lambda: any(parts.glob("results/Ref/*/speed_*.npz")), 600, "simulations of the first part")
    time.sleep(random.uniform(0.0, 4.0))  # in whatever round
    slurm.call("scancel", "--signal=KILL", "--full", f"{job}_1")
    wait_until(lambda: len(slurm.waiting(job)) < 2, 120, "the end of the killed part")
    again = slurm.submit(parts, "--array=1", PARTS="2")
    closing = slurm.submit(parts, f"--dependency=afterany:{job}:{again}")
    wait_until(lambda: not slurm.waiting(closing), 600, "the closing run")

    said = (parts / f"slurm-{closing}.out").read_text()
    assert "rule simulate:" not in said, said
    assert "look at results/explorer.html" in said
    summaries = [(folder / "results/summary.csv").read_bytes() for folder in (parts, alone)]
    assert summaries[0] == summaries[1]
    assert dataset_values(parts) == dataset_values(alone)
