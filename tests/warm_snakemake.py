"""Snakemake's command without its start: a process that has imported Snakemake and the package forks for each command.

All else is as in a process of its own: folder, arguments, environment, what it prints, its exit status. A project with a
package of its own imports that in the fork. The calls of r37 that start Snakemake may have such a fork, too.
"""

import atexit
import gc
import json
import os
import re
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import traceback
from contextlib import contextmanager, suppress
from functools import cache, partial
from hashlib import sha256
from importlib import import_module
from multiprocessing import Pipe
from pathlib import Path
from types import SimpleNamespace

from r37core.base.packages import PACKAGES
from r37core.console.caller import CALLER

CHECKOUT = Path(__file__).parent.parent
COMMON = ("dask.array", "dask.distributed", "jsonschema", "llvmlite", "nbformat", "numpy", "pandas", "pydantic", "scipy")
COMMON += ("scipy.interpolate", "scipy.linalg", "scipy.optimize", "scipy.sparse.linalg", "scipy.stats")
COMMON += ("sklearn.gaussian_process", "smart_open", "yaml")
COMMON += ("snakemake.cli", "snakemake.dag", "snakemake.profiles", "snakemake.storage", "snakemake.report.html_reporter")
"""What Snakemake imports for every plan, and steps as they run; what the rules import is read from them."""

STRUCTURE = (
    "r37core.blade.steps.geometry",
    "r37core.fem.steps.mesh",
    "r37imports.importing.steps.imported_mesh",
    "r37core.rom.steps.reduced_model",
)
STRUCTURE += (
    "r37core.rom.steps.contact_model",
    "r37core.stress.steps.stress_operator",
    "r37core.results.steps.campbell_of_blade",
)
"""Steps whose files are shared: see `_share_structures`."""


def run(folder, arguments, environment, seconds, jobs=None):
    """Exit status and what is printed, output before errors; killed after `seconds`.

    `jobs`: file for the jobs of the graph, see `plan` of tests/workflow_runs.py.
    """
    with started(folder, arguments, environment, seconds, jobs) as (process, printed):
        return process.wait(), printed()


@contextmanager
def started(folder, arguments, environment, seconds, jobs=None):
    """The process of a command, and a function for what it has printed: see `run`."""
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors, open(os.devnull) as nothing:
        streams = [stream.fileno() for stream in (nothing, output, errors)]
        yield (
            Process(folder, arguments, environment, streams, seconds, jobs=jobs and str(jobs)),
            lambda: "".join(os.pread(stream, 2**30, 0).decode() for stream in streams[1:]),
        )


def start_for_call(command, folder, environment, events, seconds=1800):
    """As `r37.workflow_process.start`."""
    arguments = command[command.index("snakemake") + 1 :]
    (reading, stdin), (errors, writing) = os.pipe(), os.pipe()
    with open(os.devnull, "w") as nothing:
        streams = [reading, nothing.fileno(), writing, events]
        process = Process(folder, arguments, environment, streams, seconds, number_in=CALLER)
    os.close(reading)
    os.close(writing)
    process.stdin, process.stderr = os.fdopen(stdin, "wb"), os.fdopen(errors, "rb")
    return process


class Process:
    """A fork with a command, which leads a group: like subprocess.Popen. It ends before the next one starts.

    `streams`: its standard ones, and one more whose number it finds in the environment as `number_in`.
    """

    def __init__(self, folder, arguments, environment, streams, seconds, **about):
        order = {"folder": str(folder), "arguments": arguments, "environment": environment, "seconds": seconds, **about}
        self._server, self._status = _server(), None
        order = json.dumps(order).encode()
        socket.send_fds(self._server, [len(order).to_bytes(4)], streams)
        self._server.sendall(order)
        self.pid = self._answer()

    def _answer(self):
        return int.from_bytes(self._server.recv(4, socket.MSG_WAITALL), signed=True)

    def poll(self):
        if self._status is None and select.select([self._server], [], [], 0.0)[0]:
            self._status = self._answer()
        return self._status

    def wait(self, timeout=None):
        if self._status is None:
            if not select.select([self._server], [], [], timeout)[0]:
                raise subprocess.TimeoutExpired("snakemake", timeout)
            self._status = self._answer()
        return self._status


@cache
def _server():
    ours, theirs = socket.socketpair()
    with theirs:
        server = subprocess.Popen([sys.executable, "-P", __file__, str(theirs.fileno())], pass_fds=[theirs.fileno()])
    atexit.register(lambda: (ours.close(), server.wait()))
    return ours


def _serve(channel):
    """Answer each order with its process, and then with the exit status.

    Returns in the fork, with its order and streams; None at the end.
    """
    while True:
        size, streams, *_ = socket.recv_fds(channel, 4, 8)
        if not size:
            return None
        order = json.loads(channel.recv(int.from_bytes(size), socket.MSG_WAITALL))
        child = os.fork()
        if child == 0:
            channel.close()
            os.setpgid(0, 0)
            return order, streams
        for stream in streams:
            os.close(stream)
        with suppress(PermissionError):
            # whoever comes first
            os.setpgid(child, child)
        channel.sendall(child.to_bytes(4))
        channel.sendall(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]).to_bytes(4, signed=True))


def _import_package():
    """What the rules take from the package of the checkout, and the modules of their steps and figures."""
    os.environ.setdefault("MPLBACKEND", "Agg")
    for file in [CHECKOUT / "Snakefile", *(CHECKOUT / "workflow").rglob("*.smk")]:
        text = file.read_text()
        names = re.findall(r"^from (r37\w+\S*) import", text, re.MULTILINE)
        steps = [*STRUCTURE, *re.findall(r'"(\w+(?:\.\w+)+\.\w+)"', text)]
        for name in {*names, *(step.rpartition(".")[0] for step in steps)}:
            with suppress(ModuleNotFoundError):
                import_module(name)


def _become(order, streams):
    """The process that a shell had started with this order."""
    os.chdir(order["folder"])
    os.environ.clear()
    os.environ.update(order["environment"])
    sys.path[:0] = order["environment"]["PYTHONPATH"].split(os.pathsep)
    if Path(sys.path[0]).resolve() != CHECKOUT / "src":
        for name in [name for name in sys.modules if name.split(".")[0] in PACKAGES]:
            del sys.modules[name]
    sys.argv = ["snakemake", *order["arguments"]]
    for number, stream in enumerate(streams[:3]):
        os.dup2(stream, number)
        os.close(stream)
    if name := order.get("number_in"):
        os.environ[name] = str(streams[3])
    if "--dry-run" not in order["arguments"]:
        _fork_job_servers()
    # which tests in the background of a shell ignore
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.alarm(order["seconds"])
    if order.get("jobs"):
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
                _share_structures()
                fork_server.serve(theirs)
            os._exit(0)
        theirs.close()
        kill = partial(os.kill, number, signal.SIGKILL)
        waiting.append((ours, SimpleNamespace(pid=number, kill=kill, wait=lambda _, number=number: os.waitpid(number, 0))))

    def start_server():
        channel, process = waiting.pop()
        # what Snakemake has set since
        channel.send(dict(os.environ))
        return channel, process

    executor.start_server = start_server


def _share_structures():
    """Let the jobs of a blade's structure copy the files of one that had the same input and parameters.

    In the cache folder of all tests: one of a test's own is for what the package itself keeps.
    """
    common = os.environ["R37_CACHE"].startswith(os.environ["R37_RUN_OF_TESTS"])
    for name in STRUCTURE if common else ():
        module, _, step = name.rpartition(".")
        # a package of one's own is not imported yet, and shares nothing
        if module in sys.modules:
            setattr(sys.modules[module], step, partial(_made_once, getattr(sys.modules[module], step)))


def _made_once(step, input, output, params):
    if not isinstance(output, import_module("snakemake.iocontainers").OutputFiles):
        # inside of another job
        return step(input, output, params)
    about = {name: str(value) for name, value in params.items() if name not in ("locations", "cores")}
    digests = [sha256(Path(file).read_bytes()).hexdigest() for file in input]
    kept = Path(os.environ["R37_CACHE"], "steps", sha256(repr((about, digests)).encode()).hexdigest())
    if kept.exists():
        atomic_write = import_module("r37core.base.io").atomic_write
        for number, file in enumerate(output):
            # as steps write: a job that is killed leaves no half of a file
            with atomic_write(file) as temporary:
                shutil.copy(kept / str(number), temporary)
        return json.loads((kept / "shown.json").read_text())
    shown, made = step(input, output, params), kept.with_name(f"{kept.name}_{os.getpid()}")
    made.mkdir(parents=True)
    for number, file in enumerate(output):
        shutil.copy(file, made / str(number))
    (made / "shown.json").write_text(json.dumps(shown))
    with suppress(OSError):
        # another job was first
        made.rename(kept)
    return shown


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
    # fonts, too
    with tempfile.TemporaryDirectory() as folder:
        style = import_module("r37core.figures.style")
        figure = style.plt.figure()
        figure.text(0.5, 0.5, "$10^{-1}$")
        style.save(figure, [f"{folder}/text.png", f"{folder}/text.pdf"])
    gc.collect()
    # what is there for good costs the forks neither a look nor a copy
    gc.freeze()
    if ordered := _serve(socket.socket(fileno=int(sys.argv[1]))):
        _become(*ordered)
        _end(import_module("snakemake.cli").main)
