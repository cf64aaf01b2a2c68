"""A process that ends what a run of the tests has left: `python guard.py FOLDER`, with a pipe as its input.

The run holds the other end of the pipe, so that the input ends with the run, however it was killed. Whatever the run has
started, directly or not, has the run's folder in the environment that it began with. Linux alone: elsewhere nothing is found.
The folder is removed.
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path

RUN = "R37_RUN_OF_TESTS"
"""Environment variable with a temporary folder of this run of the tests, for its processes."""


GRACE_S = 1.0
"""What ends by itself after the run has so long for it."""


def start_guard():
    """Start the process for this run, before any other; returns it, and whoever keeps that holds the pipe."""
    folder = tempfile.mkdtemp(prefix="r37_tests_")
    unmarked = {key: value for key, value in os.environ.items() if key != RUN}
    streams = {"stdin": subprocess.PIPE, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    # a session of its own: what ends the run by its group does not end this
    process = subprocess.Popen([sys.executable, "-S", __file__, folder], start_new_session=True, env=unmarked, **streams)
    os.environ[RUN] = folder
    return process


def left_by(run):
    """Numbers of the processes that began in this run and have not ended."""
    mark, found = f"{RUN}={run}".encode(), []
    for file in Path("/proc").glob("[0-9]*/environ"):
        # another user's, or one that has ended
        with suppress(OSError):
            if mark in file.read_bytes().split(b"\0"):
                found.append(int(file.parent.name))
    return found


if __name__ == "__main__":
    sys.stdin.read()
    time.sleep(GRACE_S)
    # what is killed may have started others meanwhile
    while left := left_by(sys.argv[1]):
        for number in left:
            with suppress(ProcessLookupError):
                os.kill(number, signal.SIGKILL)
        time.sleep(0.02)
    shutil.rmtree(sys.argv[1])
