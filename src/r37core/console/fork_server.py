"""A process that forks for each job, with what jobs need imported: `python -P -m r37core.console.fork_server DESCRIPTOR`.

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
from functools import cache
from multiprocessing.connection import Connection, wait
from types import CodeType
from typing import Any, NoReturn

from r37core.base.packages import PACKAGES
from r37core.sweep.forks import end_with_parent

# every job imports it
from . import failures as failures

_NAMES = re.compile(rb"(?:%s)(?:\.[a-z_]\w*)+" % "|".join(PACKAGES).encode())
"""Modules of the packages, and functions in them, as a job's parameters name them."""


def serve(channel: Connection) -> None:
    """Fork for every job that comes; send number and exit status of each that has ended, negative where it was killed."""
    jobs, known = dict[int, int](), frozenset[bytes]()
    ended, writing = os.pipe()
    os.set_blocking(writing, False)
    signal.signal(signal.SIGCHLD, lambda *_: None)
    signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
    with suppress(EOFError, OSError):
        while True:
            for ready in wait([channel, ended]):
                if ready is not channel:
                    os.read(ended, 4096)
                    for number, status in _ended(jobs):
                        channel.send((number, status))
                    continue
                if (job := channel.recv()) is None:
                    raise EOFError
                number, script, temporary_folder, arguments = job
                known = _import_named(arguments, known)
                snakemake, code = pickle.loads(arguments), _compiled(script)
                _make_ready(snakemake)
                if (process := os.fork()) == 0:
                    _run(code, temporary_folder, snakemake)
                jobs[process] = number
    for process in jobs:
        os.kill(process, signal.SIGTERM)
    # whoever waits for the end of this process then knows that none is left
    for process in jobs:
        os.waitpid(process, 0)


def _ended(jobs: dict[int, int]) -> list[tuple[int, int]]:
    """Numbers and statuses of the jobs, by process, that have ended; they are removed."""
    statuses = []
    with suppress(ChildProcessError):
        while (end := os.waitpid(-1, os.WNOHANG))[0]:
            process, status = end
            if process in jobs:
                statuses.append((jobs.pop(process), os.waitstatus_to_exitcode(status)))
    return statuses


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


def _make_ready(snakemake: Any) -> None:
    """Load what a job has in common with others: by a function `make_ready` next to its step, with its input and params."""
    with suppress(Exception, SystemExit):
        module = sys.modules[snakemake.params.step.rpartition(".")[0]]
        if hasattr(module, "make_ready"):
            module.make_ready(snakemake.input, snakemake.params)


def _run(code: CodeType, temporary_folder: str | None, snakemake: Any) -> NoReturn:
    """Run a script in this process, with Snakemake's object of its job, and end as it would by itself."""
    status = 1
    try:
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        end_with_parent()
        if temporary_folder:
            os.environ["TMPDIR"], tempfile.tempdir = temporary_folder, None
        exec(code, {"__name__": "__main__", "__file__": code.co_filename, "snakemake": snakemake})
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
        os._exit(status)


if __name__ == "__main__":
    serve(Connection(int(sys.argv[1])))
    # taking apart what was imported takes longer than all else
    os._exit(0)
