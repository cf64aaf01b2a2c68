"""Snakemake's command without its start: a process that has imported Snakemake forks for each command.

All else is as in a process of its own: folder, arguments, environment, what it prints, its exit status, and the project's
package, which only the fork imports.
"""

import atexit
import json
import os
import signal
import subprocess
import sys
import tempfile
from functools import cache
from importlib import import_module
from pathlib import Path

COMMON = ("llvmlite", "numpy", "pandas", "pydantic", "scipy", "yaml", "snakemake.cli", "snakemake.report.html_reporter")
"""What Snakemake and the project import for every plan."""


def run(folder, arguments, environment, seconds):
    """Exit status and what is printed, output before errors; killed after `seconds`."""
    server = _server()
    with tempfile.TemporaryDirectory() as printed:
        files = [str(Path(printed, name)) for name in ("output", "errors")]
        order = {"folder": str(folder), "arguments": arguments, "environment": environment, "files": files, "seconds": seconds}
        server.stdin.write(json.dumps(order) + "\n")
        server.stdin.flush()
        status = int(server.stdout.readline())
        return status, "".join(Path(file).read_text() for file in files)


@cache
def _server():
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    server = subprocess.Popen([sys.executable, "-P", __file__], **pipes)
    atexit.register(server.communicate)
    return server


def _serve():
    """Answer each line of JSON, an order, with the exit status. Returns in the fork, with its order; None at the end."""
    for line in sys.stdin:
        child = os.fork()
        if child == 0:
            return json.loads(line)
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
    return None


def _become(order):
    """The process that a shell had started with this order."""
    os.chdir(order["folder"])
    os.environ.clear()
    os.environ.update(order["environment"])
    sys.path[:0] = order["environment"]["PYTHONPATH"].split(os.pathsep)
    sys.argv = ["snakemake", *order["arguments"]]
    for stream, file in zip((sys.stdin, sys.stdout, sys.stderr), (os.devnull, *order["files"]), strict=True):
        with open(file, stream.mode) as opened:
            os.dup2(opened.fileno(), stream.fileno())
    signal.alarm(order["seconds"])


if __name__ == "__main__":
    for name in COMMON:
        import_module(name)
    if ordered := _serve():
        _become(ordered)
        sys.exit(import_module("snakemake.cli").main())
