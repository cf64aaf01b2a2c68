"""Snakemake's command without its start: a process that has imported Snakemake and the package forks for each command.

All else is as in a process of its own: folder, arguments, environment, what it prints, its exit status. A project with a
package of its own imports that in the fork.
"""

import atexit
import gc
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import traceback
from contextlib import contextmanager, suppress
from functools import cache, partial
from importlib import import_module
from multiprocessing import Pipe
from pathlib import Path
from types import SimpleNamespace

CHECKOUT = Path(__file__).parent.parent
COMMON = ("jsonschema", "llvmlite", "nbformat", "numpy", "pandas", "pydantic", "scipy", "smart_open", "yaml")
COMMON += ("snakemake.cli", "snakemake.dag", "snakemake.profiles", "snakemake.storage", "snakemake.report.html_reporter")
"""What Snakemake imports for every plan; what the rules import is read from them."""


def run(folder, arguments, environment, seconds, jobs=None):
    """Exit status and what is printed, output before errors; killed after `seconds`.

    `jobs`: file for the jobs of the graph, see tests/plans_of_snakemake.py.
    """
    with started(folder, arguments, environment, seconds, jobs) as (_, end):
        return end()


@contextmanager
def started(folder, arguments, environment, seconds, jobs=None):
    """Of a command that runs: its process id, which is that of a group as well, and a function that waits: see `run`."""
    server = _server()
    with tempfile.TemporaryDirectory() as printed:
        files = [str(Path(printed, name)) for name in ("output", "errors")]
        order = {"folder": str(folder), "arguments": arguments, "environment": environment, "files": files, "seconds": seconds}
        order |= {"jobs": jobs and str(jobs)}
        server.stdin.write(json.dumps(order) + "\n")
        server.stdin.flush()
        number = int(server.stdout.readline())

        def end():
            return int(server.stdout.readline()), "".join(Path(file).read_text() for file in files)

        yield number, end


@cache
def _server():
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    server = subprocess.Popen([sys.executable, "-P", __file__], **pipes)
    atexit.register(server.communicate)
    return server


def _serve():
    """Answer each line of JSON, an order, with its process, and then with the exit status.

    Returns in the fork, with its order; None at the end.
    """
    for line in sys.stdin:
        child = os.fork()
        if child == 0:
            os.setpgid(0, 0)
            return json.loads(line)
        with suppress(PermissionError):
            # whoever comes first
            os.setpgid(child, child)
        print(child, flush=True)
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
    return None


def _import_package():
    """What the rules take from the package of the checkout, and the modules of their steps and figures."""
    os.environ.setdefault("MPLBACKEND", "Agg")
    for file in [CHECKOUT / "Snakefile", *(CHECKOUT / "workflow").rglob("*.smk")]:
        text = file.read_text()
        names = re.findall(r"^from (r37core\S*) import", text, re.MULTILINE)
        for name in {*names, *(f"r37core.{module}" for module in re.findall(r'"(\w+(?:\.\w+)+)\.\w+"', text))}:
            with suppress(ModuleNotFoundError):
                import_module(name)


def _become(order):
    """The process that a shell had started with this order."""
    os.chdir(order["folder"])
    os.environ.clear()
    os.environ.update(order["environment"])
    sys.path[:0] = order["environment"]["PYTHONPATH"].split(os.pathsep)
    if Path(sys.path[0]).resolve() != CHECKOUT / "src":
        for name in [name for name in sys.modules if name.split(".")[0] == "r37core"]:
            del sys.modules[name]
    sys.argv = ["snakemake", *order["arguments"]]
    for stream, file in zip((sys.stdin, sys.stdout, sys.stderr), (os.devnull, *order["files"]), strict=True):
        with open(file, stream.mode) as opened:
            os.dup2(opened.fileno(), stream.fileno())
    if "--dry-run" not in order["arguments"]:
        _fork_job_servers()
    signal.alarm(order["seconds"])
    if order["jobs"]:
        _write_jobs(Path(order["jobs"]))


def _fork_job_servers():
    """Let the servers of the jobs be forks, which have imported what most jobs need; each waits until it is used."""
    executor, fork_server = import_module("r37core.console.executor"), import_module("r37core.console.fork_server")
    waiting = []
    for _ in range(2):
        ours, theirs = Pipe()
        if (number := os.fork()) == 0:
            os.setsid()
            for channel, _ in [*waiting, (ours, None)]:
                channel.close()
            with suppress(EOFError):
                os.environ.update(theirs.recv())
                fork_server.serve(theirs)
            os._exit(0)
        theirs.close()
        kill = partial(os.kill, number, signal.SIGKILL)
        waiting.append((ours, SimpleNamespace(pid=number, kill=kill, wait=lambda _, number=number: os.waitpid(number, 0))))

    def start_server():
        channel, process = waiting.pop()
        channel.send(dict(os.environ))
        return channel, process

    executor.start_server = start_server


def _write_jobs(file):
    """Let Snakemake's interface write the jobs that are to run, as JSON, once it has planned them."""
    from snakemake.api import DAGApi

    execute = DAGApi.execute_workflow

    def execute_and_write(self, *arguments, **options):
        execute(self, *arguments, **options)
        dag = self.workflow_api._workflow.dag
        jobs = [
            {
                "rule": job.rule.name,
                "wildcards": dict(job.wildcards_dict),
                "inputs": list(map(str, job.input)),
                "outputs": list(map(str, job.output)),
                "priority": float(job.priority),
                "because_of_params": bool(dag.reason(job).params_changed),
            }
            for job in dag.needrun_jobs(exclude_finished=False)
        ]
        file.write_text(json.dumps(jobs))

    DAGApi.execute_workflow = execute_and_write


def _end(command):
    """Run the command and end as Python does, but for taking all apart that was imported: half of a dry run's time."""
    status = 1
    try:
        command()
        status = 0
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
    finally:
        threading._shutdown()
        atexit._run_exitfuncs()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)


if __name__ == "__main__":
    for name in COMMON:
        import_module(name)
    _import_package()
    # plugins are searched for once
    import_module("snakemake.cli").get_argument_parser()
    gc.collect()
    # what is there for good costs the forks neither a look nor a copy
    gc.freeze()
    if ordered := _serve():
        _become(ordered)
        _end(import_module("snakemake.cli").main)
