"""A server that has imported what jobs need, and forks for each: `python -m r37core.console.job_server SOCKET SCRIPT`.

Importing takes longer than a simulation, and as long as drawing a figure. Jobs reach the server through
`workflow/scripts/start.py`, which hands over their arguments and its output, waits, and passes the exit status on; where no
server answers, the job runs by itself. Only its owner can talk to it: the socket is in a folder of mode 0700. It ends when its
standard input does, which Snakemake holds.
"""

from __future__ import annotations

import ast
import contextlib
import gc
import importlib
import os
import re
import runpy
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple, NoReturn

ADDRESS = "R37_JOB_SERVER"
"""Environment variable with the socket's path, for the jobs; relative, because such a path may have a hundred letters."""

_PACKAGE = (__package__ or "").partition(".")[0]

_KEPT: list[subprocess.Popen] = []
"""A server whose handle is gone has no standard input any more."""

_PATIENCE_S = 5.0
"""With a client that has come and does not say what it wants."""


def start(script: Path, python: Path) -> bool:
    """Start the server of this process, with `script` as that of most jobs; whether it is there.

    There is none where the folder can have no socket.
    """
    try:
        folder = tempfile.mkdtemp(prefix="r37_jobs_", dir=".snakemake")
        address = Path(os.path.relpath(folder)) / "socket"
        # -P: the user's folder may hold a random.py
        command = [str(python), "-P", "-m", __name__, str(address), str(script)]
        # a session of its own: the terminal's interrupt is for Snakemake, which ends the jobs
        _KEPT.append(subprocess.Popen(command, stdin=subprocess.PIPE, start_new_session=True))
        os.environ[ADDRESS] = str(address)
    except OSError:
        os.environ.pop(ADDRESS, None)
    return ADDRESS in os.environ


def serve(address: Path, script: str) -> None:
    """Fork for every connection until standard input ends; see _Imported for `script`."""
    imported = _Imported(script)
    try:
        with socket.socket(socket.AF_UNIX) as listener:
            listener.bind(str(address))
            listener.listen(256)
            signal.signal(signal.SIGCHLD, signal.SIG_IGN)
            while sys.stdin not in select.select([listener, sys.stdin], [], [])[0]:
                connection, _ = listener.accept()
                # a client that is gone, or says nothing, is done with
                with connection, contextlib.suppress(OSError), _asked(connection) as job:
                    if not _is_ours(job.arguments[0], Path(script).parent):
                        continue
                    imported.add(job.arguments[0])
                    imported.make_ready(job.arguments)
                    if os.fork() == 0:
                        listener.close()
                        _answer(connection, job)
    finally:
        shutil.rmtree(address.parent, ignore_errors=True)


class _Job(NamedTuple):
    """What a client asks for: its folder, its environment, script and arguments, and the files that its output goes to."""

    folder: str
    environment: dict[str, str]
    arguments: list[str]
    outputs: list[int]


class _Imported:
    """What the server has imported. Of `main`, a script, all is run once that stands outside its main part.

    A function `make_ready` there gets the arguments of each of its jobs, before the job.
    """

    def __init__(self, main: str):
        self._main, self._known = main, set[str]()
        self._make_ready: Callable[..., None] | None = None

    def add(self, script: str) -> None:
        """Import what a script imports, as far as that is found; what is not is the job's own affair."""
        needed = {script} if script == self._main else _imports_of(script)
        if not (new := needed - self._known):
            return
        # what is imported may start programs, and asks how they ended
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        for name in sorted(new):
            with contextlib.suppress(Exception):
                if name == self._main:
                    self._make_ready = runpy.run_path(name).get("make_ready")
                else:
                    importlib.import_module(name)
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)
        # what is imported is no garbage: no job needs to look through it, and its memory stays shared
        gc.freeze()
        self._known |= new

    def make_ready(self, arguments: list[str]) -> None:
        """Let `main`, if it says how, load what a job of it has in common with others; what fails is the job's own affair."""
        if arguments[0] == self._main and self._make_ready:
            with contextlib.suppress(Exception):
                self._make_ready(*arguments[1:])


def _is_ours(script: str, folder: Path) -> bool:
    """Whether a script is one of the `folder`, or Snakemake's copy of one.

    Those of others may need Python's own end, which closes what they leave open: they run by themselves.
    """
    ours = os.path.realpath(folder)
    if os.path.realpath(os.path.dirname(script)) == ours:
        return True
    try:
        # in the line that Snakemake puts before a copy
        return f"__file__ = {ours + os.sep!r}"[:-1] in Path(script).read_text(encoding="utf-8")
    except (OSError, ValueError):
        return False


def _imports_of(script: str) -> set[str]:
    """Modules that a script imports where it begins, and names out of them that may be modules.

    And those of our package that the job's parameters name, which stand in the line that Snakemake puts before its copy.
    """
    text = Path(script).read_text(encoding="utf-8")
    names = set(re.findall(rf"{_PACKAGE}(?:\.[a-z_]\w*)+", text))
    for node in ast.parse(text).body:
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return names


@contextlib.contextmanager
def _asked(connection: socket.socket) -> Iterator[_Job]:
    """What a client asks for; its outputs are closed here in the end. Raises OSError where it says less."""
    connection.settimeout(_PATIENCE_S)
    size = int.from_bytes(connection.recv(8, socket.MSG_WAITALL), "little")
    message, outputs, _, _ = socket.recv_fds(connection, 1, 2)
    try:
        while len(message) < size:
            part = connection.recv(size - len(message))
            if not part:
                raise ConnectionError
            message += part
        connection.settimeout(None)
        folder, number, *rest = [os.fsdecode(part) for part in message.split(b"\0")]
        environment = dict(entry.split("=", 1) for entry in rest[: int(number)])
        yield _Job(folder, environment, rest[int(number) :], outputs)
    finally:
        for output in outputs:
            os.close(output)


def _answer(connection: socket.socket, job: _Job) -> NoReturn:
    """Run a job in this process, which ends with it, or when its client is gone."""
    status = 1
    try:
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        for output, number in zip(job.outputs, (1, 2), strict=True):
            os.dup2(output, number)
        threading.Thread(target=_end_with, args=(connection,), daemon=True).start()
        os.chdir(job.folder)
        os.environ.clear()
        os.environ.update(job.environment)
        # of another TMPDIR
        tempfile.tempdir = None
        sys.argv = job.arguments
        status = _status_of(sys.argv[0])
        sys.stdout.flush()
        sys.stderr.flush()
        connection.sendall(bytes([status]))
    finally:
        os._exit(status)


def _status_of(script: str) -> int:
    """What the script would exit with by itself."""
    try:
        runpy.run_path(script, run_name="__main__")
    except SystemExit as end:
        if end.code is None or isinstance(end.code, int):
            return (end.code or 0) & 0xFF
        print(end.code, file=sys.stderr)
        return 1
    except BaseException:
        traceback.print_exc()
        return 1
    return 0


def _end_with(connection: socket.socket) -> None:
    connection.recv(1)
    os._exit(1)


if __name__ == "__main__":
    serve(Path(sys.argv[1]), sys.argv[2])
