"""A server that has imported what a simulation needs, and forks for each: `python -m r37core.console.job_server SOCKET SCRIPT`.

Importing takes longer than a simulation. Jobs reach it through `workflow/scripts/start.py`, which hands over the arguments and
its output, waits, and passes the exit status on; where no server answers, the job runs by itself. Only its owner can talk to
it: the socket is in a folder of mode 0700. It ends when its standard input does, which Snakemake holds.
"""

from __future__ import annotations

import gc
import os
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
from pathlib import Path

ADDRESS = "R37_JOB_SERVER"
"""Environment variable with the socket's path, for the jobs; relative, because such a path may have a hundred letters."""

_KEPT: list[subprocess.Popen] = []
"""A server whose handle is gone has no standard input any more."""


def start(script: Path, python: Path) -> None:
    """Start the server of this process for the jobs of `script`; without one, where the folder can have no socket."""
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


def serve(address: Path, script: str) -> None:
    """Fork for every connection until standard input ends."""
    imported = False
    try:
        with socket.socket(socket.AF_UNIX) as listener:
            listener.bind(str(address))
            listener.listen(256)
            while sys.stdin not in select.select([listener, sys.stdin], [], [])[0]:
                connection, _ = listener.accept()
                if not imported:
                    # not before the first job: a run may have none
                    runpy.run_path(script)
                    # what is imported is no garbage: no job needs to look through it, and its memory stays shared
                    gc.freeze()
                    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
                    imported = True
                if os.fork() == 0:
                    listener.close()
                    _answer(connection, script)
                connection.close()
    finally:
        shutil.rmtree(address.parent, ignore_errors=True)


def _answer(connection: socket.socket, script: str) -> None:
    """Run a job in this process, which ends with it, or when its client is gone."""
    status = 1
    try:
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        size = int.from_bytes(connection.recv(8, socket.MSG_WAITALL), "little")
        message, outputs, _, _ = socket.recv_fds(connection, 1, 2)
        while len(message) < size:
            part = connection.recv(size - len(message))
            if not part:
                return
            message += part
        for output, number in zip(outputs, (1, 2), strict=True):
            os.dup2(output, number)
        threading.Thread(target=_end_with, args=(connection,), daemon=True).start()
        sys.argv = [script, *map(os.fsdecode, message.split(b"\0"))]
        status = _status_of(script)
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
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
            return 1
        return (end.code or 0) & 0xFF
    except BaseException:
        traceback.print_exc()
        return 1
    return 0


def _end_with(connection: socket.socket) -> None:
    connection.recv(1)
    os._exit(1)


if __name__ == "__main__":
    serve(Path(sys.argv[1]), sys.argv[2])
