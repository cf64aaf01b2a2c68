"""Snakemake's executor `warm`: jobs of r37's scripts run in forks of a process that has imported what they need.

Importing takes longer than a simulation, and as long as drawing a figure. All other jobs, of other workflows too, go to
Snakemake's own local executor, and so do ours where their process was killed. Light: Snakemake imports it at every start.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from snakemake_interface_executor_plugins.executors.base import SubmittedJobInfo
from snakemake_interface_executor_plugins.executors.real import RealExecutor
from snakemake_interface_executor_plugins.registry import ExecutorPluginRegistry
from snakemake_interface_executor_plugins.settings import CommonSettings, ExecMode

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

common_settings = CommonSettings(
    non_local_exec=False, implies_no_shared_fs=False, job_deploy_sources=False, auto_deploy_default_storage_provider=False
)

PYTHON = sys.executable
"""The interpreter, before Snakemake is told how to call it."""

_END_S = 20.0
"""Longest time (s) that the end of a server is waited for, which may be importing something."""


class Executor(RealExecutor):
    """Executor of jobs on this machine. `scripts`: folder of the scripts that the server runs, set by r37's Snakefile."""

    scripts: Path | None = None
    local: type[RealExecutor] | None = None

    @classmethod
    def replace_local(cls) -> None:
        """Take the place of Snakemake's own local executor, which a cluster's job asks for, whatever its user chose."""
        registry = ExecutorPluginRegistry()
        cls.local = registry.get_plugin("local").executor
        registry.plugins["local"] = registry.get_plugin("warm")

    def __post_init__(self) -> None:
        local = self.local or ExecutorPluginRegistry().get_plugin("local").executor
        self._plain = local(self.workflow, self.logger)
        self._started: _Server | None = None

    @property
    def cores(self) -> Any:
        """Number of cores of the run."""
        return self._plain.cores

    def get_python_executable(self) -> str:
        """Interpreter of a job that is a Snakemake of its own; there is none."""
        return PYTHON

    def get_exec_mode(self) -> ExecMode:
        """Mode of a job that is a Snakemake of its own; there is none."""
        return ExecMode.SUBPROCESS

    def run_job(self, job: Any) -> None:
        """Run a job in a fork of the server, or by Snakemake's own executor."""
        script = self._script(job)
        server = self._server() if script else None
        if script is None or server is None:
            self._plain.run_job(job)
            return
        self.workflow.async_run(job.prepare())
        info = SubmittedJobInfo(job)
        server.submit(script, job, lambda status: self._ended(info, status))
        self.report_job_submission(info)

    def _script(self, job: Any) -> str | None:
        """Path of the script of a job that a server may run."""
        if self.scripts is None or job.is_group() or not job.is_script or job.is_shadow or job.benchmark:
            return None
        if self.workflow.deployment_settings.deployment_method or self.workflow.workflow_settings.cache is not None:
            return None
        script = os.path.realpath(job.rule.basedir.join(job.rule.script).get_path_or_uri(secret_free=True))
        return script if os.path.dirname(script) == os.path.realpath(self.scripts) else None

    def _server(self) -> _Server | None:
        """The server, started with the first job; None where it was killed."""
        self._started = self._started or _Server(self.logger.warning)
        return self._started if self._started.answers else None

    def _ended(self, info: SubmittedJobInfo, status: int | None) -> None:
        """Report the end of a job. One that was killed, or whose server was, runs by itself: then all is said of it."""
        if status == 0:
            self.report_job_success(info)
        elif status is None or status < 0:
            self._plain.run_job(info.job)
        else:
            self.report_job_error(info)

    def shutdown(self) -> None:
        """End the server; when this returns none of its processes is left."""
        if self._started:
            self._started.end()
        self._plain.shutdown()

    def cancel(self) -> None:
        """End the server with its jobs."""
        self.shutdown()


def start_server() -> tuple[Connection, subprocess.Popen[bytes]]:
    """Start a process of r37core.console.fork_server, and return the channel to it."""
    from multiprocessing import Pipe

    ours, theirs = Pipe()
    with theirs:
        # -P: the user's folder may hold a random.py. A session of its own: the terminal's interrupt is for Snakemake
        command = [PYTHON, "-P", "-m", "r37core.console.fork_server", str(theirs.fileno())]
        return ours, subprocess.Popen(command, stdin=subprocess.DEVNULL, pass_fds=[theirs.fileno()], start_new_session=True)


class _Server:
    """A process that forks for jobs (r37core.console.fork_server). `answers`: False once it was killed."""

    def __init__(self, tell: Callable[[str], object]):
        self.answers, self._tell, self._ending = True, tell, False
        self._ends: dict[int, Callable[[int | None], object]] = {}
        self._channel, self._process = start_server()
        threading.Thread(target=self._read, daemon=True).start()

    def submit(self, script: str, job: Any, ended: Callable[[int | None], object]) -> None:
        """Have a job done; `ended` gets its exit status, from another thread, and None where the server was killed."""
        self._ends[job.jobid] = ended
        # a server that is gone gives up all that is left
        with contextlib.suppress(OSError):
            self._channel.send((job.jobid, script, job.resources.get("tmpdir"), pickle.dumps(_about(job))))
        if not self.answers:
            self._give_up()

    def end(self) -> None:
        """End the server with the jobs that it does."""
        self._ending = True
        with contextlib.suppress(OSError):
            self._channel.send(None)
        try:
            self._process.wait(_END_S)
        except subprocess.TimeoutExpired:
            self._process.kill()

    def _read(self) -> None:
        """Take the ends of jobs until the server ends."""
        with contextlib.suppress(EOFError, OSError):
            while True:
                number, status = self._channel.recv()
                self._ends.pop(number)(status)
        self.answers = False
        if not self._ending:
            self._tell(
                f"the job server (process {self._process.pid}) was killed; no job is lost, but each starts by itself from now "
                "on, which takes longer; to have it back, end this run and give the same command again"
            )
            self._give_up()

    def _give_up(self) -> None:
        """Have others do what is left; each job once, as two threads may come here."""
        with contextlib.suppress(KeyError):
            while True:
                self._ends.popitem()[1](None)


def _about(job: Any) -> SimpleNamespace:
    """The job as our scripts know it by the name `snakemake`; Snakemake's own class tries to carry each parameter."""
    from snakemake.iocontainers import InputFiles, Log, OutputFiles, ReportHref

    files = {"input": (InputFiles, job.input), "output": (OutputFiles, job.output), "log": (Log, job.log)}
    plain = {name: kind(toclone=named, plainstr=True) for name, (kind, named) in files.items()}
    about = {"params": job.params, "wildcards": job.wildcards, "rule": job.rule.name, "threads": job.threads}
    return SimpleNamespace(**plain, **about, report_href=ReportHref)
