"""A process that forks for jobs, with what they need imported: `python -P -m r37core.console.fork_server DESCRIPTOR`.

At the file descriptor is a channel to the executor (r37core.console.executor), which sends jobs and gets their exit status. The
process ends, with its jobs, when the executor says so or is gone.
"""

import gc
import importlib
import os
import pickle
import re
import signal
import sys
import tempfile
import traceback
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from multiprocessing.connection import Connection, Pipe, wait
from types import CodeType
from typing import Any, NoReturn

from r37core.base.packages import PACKAGES
from r37core.sweep.forks import end_with_parent

# every job imports it
from . import failures as failures

_Job = tuple[str, str | None, bytes]
"""Script, folder for temporary files, and Snakemake's object of a job, pickled."""

_NAMES = re.compile(rb"(?:%s)(?:\.[a-z_]\w*)+" % "|".join(PACKAGES).encode())
"""Modules of the packages, and functions in them, as a job's parameters name them."""


@dataclass
class _Worker:
    """A forked process, the number of the job that it does, if any, and what its jobs have in common."""

    channel: Connection
    number: int | None
    common: object


def serve(channel: Connection) -> None:
    """Have every job that comes done by a fork; send number and exit status of each, negative where its process was killed.

    A process does several jobs, one after another, where these have something in common: a fork for each would copy what they
    write to, again and again.
    """
    workers, known = dict[int, _Worker](), frozenset[bytes]()
    ended, writing = os.pipe()
    os.set_blocking(writing, False)
    signal.signal(signal.SIGCHLD, lambda *_: None)
    signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
    with suppress(EOFError, OSError):
        while True:
            working: dict[Any, _Worker] = {worker.channel: worker for worker in workers.values() if worker.number is not None}
            for ready in wait([channel, ended, *working]):
                if ready is ended:
                    os.read(ended, 4096)
                    statuses = _ended(workers)
                elif ready is not channel:
                    statuses = _done(working[ready])
                elif (job := channel.recv()) is None:
                    raise EOFError
                else:
                    number, script, temporary_folder, arguments = job
                    known, statuses = _import_named(arguments, known), []
                    _compiled(script)
                    _submit(workers, number, (script, temporary_folder, arguments), _make_ready(pickle.loads(arguments)))
                for status in statuses:
                    channel.send(status)
    for process in workers:
        os.kill(process, signal.SIGTERM)
    # whoever waits for the end of this process then knows that none is left
    for process in workers:
        os.waitpid(process, 0)


def _submit(workers: dict[int, _Worker], number: int, job: _Job, common: object) -> None:
    """Give a job to a process that waits for one of its kind, or to a new one; as many may wait for others as then work."""
    waiting = [worker for worker in workers.values() if worker.number is None]
    for worker in waiting:
        if common is not None and worker.common == common:
            worker.number = number
            # one that was killed says so by its end
            with suppress(OSError):
                worker.channel.send(job)
            return
    most = len(workers) - len(waiting) + 1
    for worker in waiting[: max(len(waiting) - most, 0)]:
        worker.common = None
        with suppress(OSError):
            worker.channel.send(None)
    ours, theirs = Pipe()
    if (process := os.fork()) == 0:
        _work(theirs, job, alone=common is None)
    theirs.close()
    workers[process] = _Worker(ours, number, common)


def _done(worker: _Worker) -> list[tuple[int | None, int]]:
    """Number and status of the job that a process has done and waits after; none where it ends, which its signal says."""
    with suppress(EOFError, OSError):
        status = worker.number, worker.channel.recv()
        worker.number = None
        return [status]
    return []


def _ended(workers: dict[int, _Worker]) -> list[tuple[int | None, int]]:
    """Numbers and statuses of the jobs whose processes have ended; these are removed."""
    statuses = []
    with suppress(ChildProcessError):
        while (end := os.waitpid(-1, os.WNOHANG))[0]:
            process, status = end
            if worker := workers.pop(process, None):
                worker.channel.close()
                statuses.append((worker.number, os.waitstatus_to_exitcode(status)))
    return [status for status in statuses if status[0] is not None]


def _import_named(arguments: bytes, known: frozenset[bytes]) -> frozenset[bytes]:
    """Import the modules that a job's arguments name, but for those `known`; what fails is the job's own affair."""
    names = frozenset(_NAMES.findall(arguments))
    if names <= known:
        return known
    for name in sorted(names - known):
        with suppress(Exception, SystemExit):
            importlib.import_module(name.decode())
    # what is imported is no garbage: no job needs to look through it, and its memory stays shared
    gc.freeze()
    return known | names


@cache
def _compiled(script: str) -> CodeType:
    with open(script, encoding="utf-8") as file:
        return compile(file.read(), script, "exec")


def _make_ready(snakemake: Any) -> object:
    """Load what a job has in common with others, by a function `make_ready` next to its step, with its input and params.

    Gives what that function gives: the same for jobs that one process may do, one after another. None for other jobs.
    """
    with suppress(Exception, SystemExit):
        module = sys.modules[snakemake.params.step.rpartition(".")[0]]
        if hasattr(module, "make_ready"):
            return module.make_ready(snakemake.input, snakemake.params)
    return None


def _work(channel: Connection, job: _Job | None, alone: bool) -> NoReturn:
    """Do a job in this process, and those that come after it unless it is `alone`; end with the first one that fails."""
    status = 1
    with suppress(BaseException):
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        end_with_parent()
        while job is not None and (status := _run(*job)) == 0 and not alone:
            channel.send(status)
            # until the next job has been done it has failed
            status, job = 1, channel.recv()
    os._exit(0 if job is None else status)


def _run(script: str, temporary_folder: str | None, arguments: bytes) -> int:
    """Run a script with Snakemake's object of its job; gives the exit status that it would have by itself."""
    status = 1
    try:
        if temporary_folder:
            os.environ["TMPDIR"], tempfile.tempdir = temporary_folder, None
        exec(_compiled(script), {"__name__": "__main__", "__file__": script, "snakemake": pickle.loads(arguments)})
        status = 0
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
    except BaseException:
        traceback.print_exc()
    finally:
        with suppress(OSError):
            sys.stdout.flush()
            sys.stderr.flush()
    return status


if __name__ == "__main__":
    # xarray would import it with the first file that it opens, which takes longer than most jobs; none of them uses it
    sys.modules["dask"] = None  # type: ignore[assignment]
    serve(Connection(int(sys.argv[1])))
    # taking apart what was imported takes longer than all else
    os._exit(0)
