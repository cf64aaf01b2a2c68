"""A process that ends what a run of the tests has left: `python guard.py FOLDER`, with a pipe as its input.

The run holds the other end of the pipe, so that the input ends with the run, however it was killed. Whatever the run has
started, directly or not, has the run's folder in the environment that it began with. Linux alone: elsewhere nothing is found.
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


class Guard:
    """The process for this run, which has to be started before any other."""

    def __init__(self):
        folder = tempfile.mkdtemp(prefix="r37_tests_")
        unmarked = {key: value for key, value in os.environ.items() if key != RUN}
        # a session of its own: what ends the run by its group does not end this
        command = [sys.executable, "-S", __file__, folder]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, start_new_session=True, env=unmarked)
        os.environ[RUN] = folder

    def end(self):
        """End what is left now, and remove the folder."""
        self._process.stdin.close()
        self._process.wait()


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
    # what is killed may have started others meanwhile
    while left := left_by(sys.argv[1]):
        for number in left:
            with suppress(ProcessLookupError):
                os.kill(number, signal.SIGKILL)
        time.sleep(0.02)
    shutil.rmtree(sys.argv[1])
