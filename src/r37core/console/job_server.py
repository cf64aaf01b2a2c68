"""A server that has imported what jobs need, and forks for each: `python -m r37core.console.job_server SOCKET SCRIPT`.

Importing takes longer than a simulation, and as long as drawing a figure. Jobs reach the server through
`workflow/scripts/start.py`, which hands over their arguments and its output, waits, and passes the exit status on; where no
server answers, the job runs by itself. Simulations are forked from the server, which stays light. A process of its own has
imported what all other jobs need. Only its owner can talk to the server: the socket is in a folder of mode 0700. It ends when
its standard input does, which Snakemake holds, and before Snakemake does unless that is killed.
"""

from __future__ import annotations

import ast
import atexit
import contextlib
import errno
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
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn

from .job_requests import PATIENCE_S, Client, Job, passed_on

ADDRESS = "R37_JOB_SERVER"
"""Environment variable with the socket's path, for the jobs; relative, because such a path may have a hundred letters."""

_PACKAGE = (__package__ or "").partition(".")[0]

_KEPT: list[subprocess.Popen] = []
"""A server whose handle is gone has no standard input any more."""

_FOLDERS = "r37_jobs_"
"""How the names of the folders of sockets begin."""

_STOPPED_S = 2.0
"""How long a server may be stopped: who pauses all processes of a machine continues them one after another."""

_END_S = 20.0
"""How long Snakemake waits for the end of its server, which may be importing something."""

_MOST_CLIENTS = 128
"""That are read at once; others wait in the system's queue."""

_LONGEST_SCRIPT = 2**26
"""Bytes; the copies that Snakemake makes have a job's parameters in them."""


def start(script: Path, python: Path, say: Callable[[str], object]) -> bool:
    """Start the server of this process, with `script` as that of most jobs; whether it is there.

    There is none where the folder can have no socket. `say` is called, from another thread, if the server ends before us.
    """
    os.environ.pop(ADDRESS, None)
    try:
        _remove_deserted(Path(".snakemake"))
        folder = Path(tempfile.mkdtemp(prefix=_FOLDERS, dir=".snakemake"))
        address = Path(os.path.relpath(folder)) / "socket"
        # -P: the user's folder may hold a random.py
        command = [str(python), "-P", "-m", __name__, str(address), str(script)]
        # a session of its own: the terminal's interrupt is for Snakemake, which ends the jobs
        server = subprocess.Popen(command, stdin=subprocess.PIPE, start_new_session=True)
    except OSError:
        return False
    _KEPT.append(server)
    os.environ[ADDRESS] = str(address)
    threading.Thread(target=_watch, args=(server, folder.absolute(), say), daemon=True).start()
    atexit.register(_end, server, folder.absolute())
    return True


def _end(server: subprocess.Popen, folder: Path) -> None:
    """End a server; when this returns its folder is gone, which whoever copies or removes a finished project counts on."""
    with contextlib.suppress(OSError):
        server.stdin.close()  # type: ignore[union-attr]
    try:
        server.wait(_END_S)
    except subprocess.TimeoutExpired:
        server.kill()
    shutil.rmtree(folder, ignore_errors=True)


def _remove_deserted(place: Path) -> None:
    """Remove the folders of servers that were killed: nobody listens at their sockets."""
    for address in place.glob(f"{_FOLDERS}*/socket"):
        with socket.socket(socket.AF_UNIX) as client, contextlib.suppress(OSError):
            client.settimeout(1.0)
            if client.connect_ex(os.path.relpath(address)) == errno.ECONNREFUSED:
                shutil.rmtree(address.parent)


def _watch(server: subprocess.Popen, folder: Path, say: Callable[[str], object]) -> None:
    """Wait until a server ends, and say so unless all is well; one that is stopped is killed, as its clients wait for it."""
    options = os.WSTOPPED | os.WNOWAIT
    try:
        while (end := os.waitid(os.P_PID, server.pid, options | os.WEXITED)) and end.si_code == os.CLD_STOPPED:
            time.sleep(_STOPPED_S)
            if os.waitid(os.P_PID, server.pid, options | os.WNOHANG):
                server.kill()
    except ChildProcessError:
        # somebody else has waited for it
        return
    if end and end.si_status and not server.stdin.closed:  # type: ignore[union-attr]
        shutil.rmtree(folder, ignore_errors=True)
        say(
            f"the job server (process {server.pid}) was stopped or killed; no job is lost, but each starts by itself from now "
            "on, which takes longer; to have it back, end this run and give the same command again"
        )


def serve(address: Path, script: str) -> None:
    """Fork for every client until standard input ends, whatever clients do; see _Imported for `script`."""
    imported, steps = _Imported(script), _Steps(script)
    clients: list[Client] = []
    try:
        with socket.socket(socket.AF_UNIX) as listener:
            # a socket that nobody listens at yet is taken for that of a killed server
            listener.bind(new := str(address.with_name("new")))
            listener.listen(256)
            os.rename(new, address)
            signal.signal(signal.SIGCHLD, signal.SIG_IGN)
            while sys.stdin not in (ready := _ready(listener, clients)):
                if listener in ready:
                    # it may be gone already
                    with contextlib.suppress(OSError):
                        clients.append(Client(listener.accept()[0]))
                for client in clients.copy():
                    others = [listener, *(other for other in clients if other is not client)]
                    if _served(client, imported, steps, others) if client.connection in ready else client.is_late():
                        client.close()
                        clients.remove(client)
    finally:
        shutil.rmtree(address.parent, ignore_errors=True)


def _ready(listener: socket.socket, clients: list[Client]) -> list[Any]:
    """Whom there is to listen to: standard input, new clients unless there are many, and those that say something."""
    new = [listener] if len(clients) < _MOST_CLIENTS else []
    watched = [sys.stdin, *new, *(client.connection for client in clients)]
    return select.select(watched, [], [], PATIENCE_S / 10.0 if clients else None)[0]


def _served(client: Client, imported: _Imported, steps: _Steps, open_here: list[Any]) -> bool:
    """Listen to a client; whether it is done with: its job is under way, or it has said what no client of ours says.

    `open_here`: what a job has no use for, to be closed in its process.
    """
    try:
        job = client.read()
        if job is None:
            return False
        if os.path.abspath(job.arguments[0]) == os.path.abspath(imported.main):
            imported.make_ready(job.arguments)
            if os.fork() == 0:
                _answer(client.connection, job, [*open_here, steps])
        elif _is_ours(job.arguments[0], Path(imported.main).parent):
            steps.take(client, open_here)
    except Exception:
        # a client that gets no answer runs its job itself
        return True
    return True


class _Steps:
    """A process that forks for the jobs of all scripts but the main one, begun with the first of them.

    What these import, of VTK and others, would make the fork and the end of each simulation twenty milliseconds longer.
    """

    def __init__(self, main: str):
        self._main = main
        self._connection: socket.socket | None = None

    def take(self, client: Client, open_here: list[Any]) -> None:
        """Pass a client on; `open_here`: what that process has no use for. Raises OSError where it has been killed."""
        ours = self._connection
        if ours is None:
            ours, theirs = socket.socketpair()
            if os.fork() == 0:
                for other in (*open_here, client, ours):
                    other.close()
                _serve_steps(theirs, self._main)
            theirs.close()
            self._connection = ours
        try:
            client.pass_on(ours)
        except OSError:
            self.close()
            raise

    def close(self) -> None:
        """Leave the process, which ends when all have left it; the next client begins another one."""
        if self._connection is not None:
            self._connection.close()
            self._connection = None


def _serve_steps(source: socket.socket, main: str) -> NoReturn:
    """Fork for every client that the server passes on, until it ends."""
    imported = _Imported(main)
    try:
        while passed := passed_on(source):
            client, job = passed
            # a client that gets no answer runs its job itself
            with contextlib.suppress(Exception):
                imported.add(job.arguments[0])
                if os.fork() == 0:
                    _answer(client.connection, job, [source])
            client.close()
    finally:
        os._exit(0)


class _Imported:
    """What the server has imported. Of `main`, a script, all is run once that stands outside its main part.

    A function `make_ready` there gets the arguments of each of its jobs, before the job.
    """

    def __init__(self, main: str):
        self.main, self._known = main, set[str]()
        self._make_ready: Callable[..., None] | None = None

    def add(self, script: str) -> None:
        """Import what a script imports, as far as that is found; what is not is the job's own affair."""
        needed = {script} if script == self.main else _imports_of(script)
        if not (new := needed - self._known):
            return
        # what is imported may start programs, and asks how they ended
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        for name in sorted(new):
            with contextlib.suppress(Exception, SystemExit):
                if name == self.main:
                    self._make_ready = runpy.run_path(name).get("make_ready")
                else:
                    importlib.import_module(name)
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)
        # what is imported is no garbage: no job needs to look through it, and its memory stays shared
        gc.freeze()
        self._known |= new

    def make_ready(self, arguments: list[str]) -> None:
        """Import `main` and let it load, if it says how, what its jobs have in common; what fails is the job's own affair."""
        self.add(self.main)
        if self._make_ready:
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
        return f"__file__ = {ours + os.sep!r}"[:-1] in _text_of(script)
    except (OSError, ValueError):
        return False


def _text_of(script: str) -> str:
    """Raises OSError for what is no file, and ValueError for one that is too long to be a script."""
    # not waiting for what others write, as a pipe would
    with open(os.open(script, os.O_RDONLY | os.O_NONBLOCK), encoding="utf-8") as stream:
        text = stream.read(_LONGEST_SCRIPT)
    if len(text) == _LONGEST_SCRIPT:
        raise ValueError("too long to be a script")
    return text


def _imports_of(script: str) -> set[str]:
    """Modules that a script imports where it begins, and names out of them that may be modules.

    And those of our package that the job's parameters name, which stand in the line that Snakemake puts before its copy.
    """
    text = _text_of(script)
    names = set(re.findall(rf"{_PACKAGE}(?:\.[a-z_]\w*)+", text))
    for node in ast.parse(text).body:
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return names


def _answer(connection: socket.socket, job: Job, open_here: list[Any]) -> NoReturn:
    """Run a job in this process, which ends with it, or when its client is gone. `open_here`: what is closed before."""
    status = 1
    try:
        for other in open_here:
            other.close()
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
    """End this process when its client is gone."""
    connection.recv(1)
    os._exit(1)


if __name__ == "__main__":
    serve(Path(sys.argv[1]), sys.argv[2])
    # Snakemake waits, and taking apart what was imported takes longer than all else
    os._exit(0)
