"""A server that has imported what jobs need, and forks for each: `python -m r37core.console.job_server SOCKET SCRIPT`.

Importing takes longer than a simulation, and as long as drawing a figure. Jobs reach the server through
`workflow/scripts/start.py`. That script hands over its arguments and its output, waits, and passes the exit status on; where no
server answers, the job runs by itself. One process forks the jobs of SCRIPT, the simulations, and stays light: VTK and others
would make the fork and the end of each job twenty milliseconds longer. A second process, at SOCKET_steps, forks the steps. Only
the owner can reach them, because the sockets lie in a folder of mode 0700. The server ends when its standard input ends, which
Snakemake holds.
"""

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
import struct
import subprocess
import sys
import tempfile
import threading
import time
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple, NoReturn

ADDRESS = "R37_JOB_SERVER"
"""Environment variable with the socket's path, for the jobs; relative, because such a path may have a hundred letters."""

_PACKAGE = (__package__ or "").partition(".")[0]

_KEPT: list[subprocess.Popen] = []
"""Running servers: one whose handle is gone has no standard input any more."""

_PATIENCE_S = 5
"""How long (s) a client may take to say what it wants."""

_FOLDERS = "r37_jobs_"
"""How the names of the folders of sockets begin."""

_STOPPED_S = 2.0
"""How long (s) a server may be stopped: users who pause all processes of a machine continue them one after another."""

_END_S = 20.0
"""How long (s) Snakemake waits for the end of its server, which may be importing something."""


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
    """Wait until a server ends, and report it unless all is well; one that is stopped is killed, as its clients wait for it."""
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
    """Fork for every client until standard input ends."""
    try:
        with _listening(f"{address}_steps") as steps, _listening(str(address)) as jobs:
            signal.signal(signal.SIGCHLD, signal.SIG_IGN)
            if not (second := os.fork()):
                jobs.close()
                _fork_for_clients(steps, _Steps(Path(script).parent).prepare)
                os._exit(0)
            steps.close()
            _fork_for_clients(jobs, _Simulations(script).prepare)
        with contextlib.suppress(ChildProcessError):
            os.waitpid(second, 0)
    finally:
        shutil.rmtree(address.parent, ignore_errors=True)


def _listening(address: str) -> socket.socket:
    listener = socket.socket(socket.AF_UNIX)
    # a socket that is there is one that somebody listens at
    listener.bind(f"{address}_new")
    listener.listen(256)
    os.rename(f"{address}_new", address)
    return listener


def _fork_for_clients(listener: socket.socket, prepare: Callable[[list[str]], object]) -> None:
    """Run the job of each client in a process of its own until standard input ends; `prepare` takes its arguments before."""
    while sys.stdin not in select.select([sys.stdin, listener], [], [])[0]:
        # a client that gets no answer runs its job itself
        with contextlib.suppress(Exception), listener.accept()[0] as client, contextlib.ExitStack() as files:
            job = _read_job(client, files)
            prepare(job.arguments)
            if os.fork() == 0:
                listener.close()
                _answer(client, job)


class _Job(NamedTuple):
    """Request of a client: its folder, its environment, script and arguments, and the files that its output goes to."""

    folder: str
    environment: dict[str, str]
    arguments: list[str]
    outputs: list[int]


def _read_job(client: socket.socket, files: contextlib.ExitStack) -> _Job:
    """The job of a client; `files` closes its outputs. Raises ValueError and OSError for what start.py does not send."""
    client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, struct.pack("ll", _PATIENCE_S, 0))
    size = int.from_bytes(client.recv(8, socket.MSG_WAITALL), "little")
    first, outputs, _, _ = socket.recv_fds(client, 1, 2)
    for output in outputs:
        files.callback(os.close, output)
    message = first + client.recv(size - 1, socket.MSG_WAITALL)
    client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, struct.pack("ll", 0, 0))
    folder, number, *rest = map(os.fsdecode, message.split(b"\0"))
    entries, arguments = rest[: int(number)], rest[int(number) :]
    if len(message) != size or len(outputs) != 2 or not arguments:
        raise ValueError("no message of a job")
    return _Job(folder, dict(entry.split("=", 1) for entry in entries), arguments, outputs)


class _Simulations:
    """Preparation of the jobs of one `script`: all of it is run once that stands outside its main part.

    A function `make_ready` in the script gets the arguments of each of its jobs, before the job.
    """

    def __init__(self, script: str):
        self._script = os.path.abspath(script)
        self._make_ready: Callable[..., object] | None = None

    def prepare(self, arguments: list[str]) -> None:
        """Load what the jobs have in common. What fails is the job's own affair; ValueError for another script."""
        if os.path.abspath(arguments[0]) != self._script:
            raise ValueError("another script")
        with contextlib.suppress(Exception, SystemExit):
            if self._make_ready is None:
                self._make_ready = lambda *_: None
                with _importing():
                    self._make_ready = runpy.run_path(self._script).get("make_ready", self._make_ready)
            self._make_ready(*arguments[1:])


class _Steps:
    """Preparation of jobs of the scripts in a `folder`: what they import is imported once."""

    def __init__(self, folder: Path):
        self._folder, self._known = os.path.realpath(folder), set[str]()

    def prepare(self, arguments: list[str]) -> None:
        """Import what a script imports, as far as that is found; what is not is the job's own affair.

        Raises ValueError for a script of others, which may need Python's own end: it closes what they leave open.
        """
        script = arguments[0]
        text = Path(script).read_text(encoding="utf-8")
        # a copy that Snakemake makes names our script in a line before it
        ours = os.path.dirname(os.path.realpath(script)) == self._folder
        if not (ours or f"__file__ = {self._folder + os.sep!r}"[:-1] in text):
            raise ValueError("another script")
        if new := _imports_of(text) - self._known:
            with _importing():
                for name in sorted(new):
                    with contextlib.suppress(Exception, SystemExit):
                        importlib.import_module(name)
            self._known |= new


@contextlib.contextmanager
def _importing() -> Iterator[None]:
    # what is imported may start programs, and asks how they ended
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    try:
        yield
    finally:
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)
        # what is imported is no garbage: no job needs to look through it, and its memory stays shared
        gc.freeze()


def _imports_of(text: str) -> set[str]:
    """Modules that a script imports where it begins, and names out of them that may be modules.

    Modules of our package that the job's parameters name are among them; they stand in the line that Snakemake puts before its
    copy.
    """
    names = set(re.findall(rf"{_PACKAGE}(?:\.[a-z_]\w*)+", text))
    for node in ast.parse(text).body:
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return names


def _answer(client: socket.socket, job: _Job) -> NoReturn:
    """Run a job in this process, which ends with it, or when its client is gone."""
    status = 1
    try:
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        for output, number in zip(job.outputs, (1, 2), strict=True):
            os.dup2(output, number)
        threading.Thread(target=_end_with, args=(client,), daemon=True).start()
        os.chdir(job.folder)
        os.environ.clear()
        os.environ.update(job.environment)
        # the job may have another TMPDIR
        tempfile.tempdir = None
        sys.argv = job.arguments
        status = _status_of(sys.argv[0])
        sys.stdout.flush()
        sys.stderr.flush()
        client.sendall(bytes([status]))
    finally:
        os._exit(status)


def _status_of(script: str) -> int:
    """Exit status that the script would have by itself."""
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


def _end_with(client: socket.socket) -> None:
    """End this process when its client is gone."""
    client.recv(1)
    os._exit(1)


if __name__ == "__main__":
    serve(Path(sys.argv[1]), sys.argv[2])
    # Snakemake waits, and taking apart what was imported takes longer than all else
    os._exit(0)
