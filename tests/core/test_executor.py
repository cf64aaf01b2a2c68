"""Jobs in forks of a server that has imported what they need, and by Snakemake's own executor where there is none."""

import os
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from snakemake.iocontainers import InputFiles
from stubbed_runs import copy_stubbed
from workflow_runs import snakemake, wait_until

from r37core.console import executor

LONGEST = 200.0
"""What is waited for (s), however busy the machine is."""

SCRIPT = """
import os, sys, tempfile, time
from pathlib import Path
print("said", flush=True)
print("warned", file=sys.stderr, flush=True)
what = snakemake.params.what
Path(snakemake.output[0]).write_text(f"{os.getppid()} {os.getpid()} {tempfile.gettempdir()}")
if what == "sleep":
    time.sleep(1000)
if what == "raise":
    raise ValueError("no")
if what == "text":
    sys.exit("no")
if what == "none":
    sys.exit()
if what == "modules":
    Path(snakemake.output[0]).write_text(" ".join({"wave", "r37core.figures.maps", "r37core.rom.steps"} & set(sys.modules)))
if what == "dask":
    import xarray
    from r37core.base.dataset_file import read_dataset, write_dataset
    write_dataset(xarray.Dataset({"flag": ("place", [1, 2])}), "some.nc")
    read_dataset("some.nc")
    Path(snakemake.output[0]).write_text(str([name for name in sys.modules if name.startswith("dask.")]))
if what == "ready":
    from r37core.time_integration import speed_job
    Path(snakemake.output[0]).write_text(str(sorted(task for _, task in speed_job._READY)))
sys.exit(int(what) if what.isdigit() else 0)
"""


def files(**named):
    return InputFiles(fromdict=named)


@pytest.fixture
def server(root, tmp_path, monkeypatch):
    """A server in a folder of its own; `told` is what it said to the user."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(root / "src"), str(tmp_path / "modules")]))
    Path("script.py").write_text(SCRIPT)
    told, own = [], [os.dup(number) for number in (1, 2)]
    with open("printed", "w") as printed:
        for number in (1, 2):
            os.dup2(printed.fileno(), number)
        one = executor._Server(told.append)
        for number, before in zip((1, 2), own, strict=True):
            os.dup2(before, number)
            os.close(before)
    one.told = told
    yield one
    one.end()
    assert one._process.poll() is not None


@pytest.fixture
def start(server):
    """Starts a job; the list that is returned gets its exit status."""

    def one(what, out="out", **params):
        number, statuses = len(os.listdir()) * 1000 + len(server._ends), []
        job = SimpleNamespace(
            jobid=number,
            resources={"tmpdir": os.getcwd()},
            input=files(models="missing.nc"),
            output=files(out=out),
            params=SimpleNamespace(what=what, **params),
            wildcards={},
            log=files(),
            rule=SimpleNamespace(name="a_rule"),
            threads=1,
        )
        server.submit("script.py", job, statuses.append)
        return statuses

    return one


def status_of(statuses):
    wait_until(lambda: statuses, LONGEST, "the end of a job")
    return statuses[0]


def process_of(out="out"):
    """Number of the process of a job, once it runs."""
    wait_until(lambda: Path(out).exists() and Path(out).read_text(), LONGEST, out)
    return int(Path(out).read_text().split()[1])


def is_gone(process):
    stat = Path(f"/proc/{process}/stat")
    return not stat.exists() or stat.read_text().rpartition(")")[2].split()[0] == "Z"


@pytest.mark.parametrize(("what", "status"), [("0", 0), ("3", 3), ("raise", 1), ("text", 1), ("none", 0)])
def test_output_and_status_are_those_of_the_job(start, server, what, status):
    assert status_of(start(what)) == status
    parent, _, temporary = Path("out").read_text().split()
    assert (int(parent), temporary) == (server._process.pid, os.getcwd())
    printed = Path("printed").read_text()
    assert printed.startswith("said\nwarned\n")
    assert ("no" in printed) == (what in ("raise", "text"))


def test_modules_that_the_parameters_name_are_there_before_the_job(start):
    """Not those of the user's folder, nor what fails."""
    Path("random.py").write_text("raise SystemExit(9)")
    named = {"draw": "r37core.figures.maps.map_figure", "other": "r37core.none", "wave": "wave"}
    assert status_of(start("modules", **named)) == 0
    assert Path("out").read_text() == "r37core.figures.maps"


def test_what_jobs_have_in_common_is_loaded_before_them(start):
    """By `make_ready` next to the step; a failure there, as of these models, is not the job's."""
    for number, found in (("1", "['1']"), ("2", "['1', '2']"), ("2", "['1', '2']")):
        job = {"speed": "1000", "task": number}
        assert status_of(start("ready", step="r37core.time_integration.speed_job.simulate", job=job)) == 0
        assert Path("out").read_text() == found


@pytest.fixture
def work(start):
    """Does a job that has all in common with others of the same task; gives its status and process."""
    known = set()

    def one(what, task):
        params = {"step": "r37core.time_integration.speed_job.simulate", "job": {"speed": "1000", "task": task}}
        if task not in known:
            # whose missing model no other looks for
            known.add(task)
            status_of(start("0", **params))
        return status_of(start(what, **params)), process_of()

    return one


def test_jobs_with_all_in_common_are_done_by_one_process_after_another(work):
    """It ends with a job that fails, does none of another kind, and may be killed while it waits."""
    (_, first), (_, other), (_, second) = (work("0", task) for task in "aba")
    assert first == second != other
    assert work("3", "a") == (3, first)
    status, third = work("0", "a")
    assert (status, third == first) == (0, False)
    os.kill(third, signal.SIGKILL)
    wait_until(lambda: not Path(f"/proc/{third}").exists(), LONGEST, "the end of a process")
    assert work("0", "a")[0] == 0


def test_no_more_processes_wait_than_work(work, server):
    for task in "abcd":
        assert work("0", task)[0] == 0
    children = Path(f"/proc/{server._process.pid}/task/{server._process.pid}/children")
    wait_until(lambda: len(children.read_text().split()) == 2, LONGEST, "two processes")


def test_no_job_imports_dask(start, server):
    assert status_of(start("dask")) == 0
    assert Path("out").read_text() == "[]"


def test_jobs_side_by_side_and_one_that_is_killed(start, server):
    """Which has the signal as its status."""
    jobs = [start("4", out=f"out_{number}") for number in range(30)]
    assert {status_of(job) for job in jobs} == {4}
    assert {Path(f"out_{number}").read_text().split()[0] for number in range(30)} == {str(server._process.pid)}
    job = start("sleep")
    os.kill(process_of(), signal.SIGKILL)
    assert status_of(job) == -signal.SIGKILL
    assert status_of(start("0")) == 0 and server.told == []


def test_a_server_that_is_killed_gives_up_its_jobs_and_takes_no_more(start, server):
    job = start("sleep")
    process = process_of()
    server._process.kill()
    assert status_of(job) is None
    assert status_of(start("0")) is None
    assert not server.answers
    (line,) = server.told
    assert f"job server (process {server._process.pid}) was killed" in line and "the same command again" in line
    wait_until(lambda: is_gone(process), LONGEST, "the end of the job")


def test_the_end_of_a_server_is_that_of_its_jobs(start, server):
    job = start("sleep")
    process = process_of()
    server.end()
    assert is_gone(process)
    assert (job, server.told) == ([], [])


def test_a_server_ends_with_its_snakemake(root, tmp_path):
    """Also one that is killed."""
    code = "from r37core.console import executor\nprint(executor.start_server()[1].pid, flush=True)\ninput()\n"
    snakemake = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=tmp_path)
    process = int(snakemake.stdout.readline())
    snakemake.kill()
    wait_until(lambda: is_gone(process), LONGEST, "the end of the server")
    snakemake.communicate()


def test_linear_algebra_has_one_thread_in_a_job_of_several_cores(root, tmp_path):
    """Loaded before the script, as by what Snakemake carries into it, or after."""
    script = root / "workflow/scripts/step.py"
    program = f"""
import sys, numpy
from types import SimpleNamespace as Some
from r37core.console import caller as step

def done(input, output, params):
    import scipy.linalg, threadpoolctl
    print([library["num_threads"] for library in threadpoolctl.threadpool_info()])

step.done = done
params = Some(step="r37core.console.caller.done")
snakemake = Some(params=params, threads=2, wildcards={{}}, rule="rule", log=["log"], input=None, output=None)
exec(compile(open({str(script)!r}).read(), "step.py", "exec"))
"""
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "2", "OMP_NUM_THREADS": "2"}
    subprocess.run([sys.executable, "-c", program], cwd=tmp_path, env=environment, check=True)
    assert set((tmp_path / "log").read_text()) == set("[1, ]\n")


@pytest.fixture
def project(root, tmp_path):
    """A sweep whose script also writes who made each output."""
    copy_stubbed(root, tmp_path)
    script = tmp_path / "workflow/scripts/step.py"
    script.write_text(f"{script.read_text()}\n{ONCE}")
    return tmp_path


ONCE = """
import os, signal
first = Path("killed")
if snakemake.rule == "geometry" and snakemake.wildcards.blade == "Ref" and not first.exists():
    first.write_text("")
    os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["warm", "local"])
def test_every_job_is_done_by_either_executor(project, name):
    """With the executor also one whose process is killed, which then runs by itself."""
    if name == "local":
        (project / "killed").write_text("")
    text = snakemake(project, "results/Ref/direct/response.nc", "--cores", "2", "--executor", name)
    assert "(100%) done" in text and (project / "killed").exists()
    assert ("each job starts by itself" in text) == (name == "local")


@pytest.mark.slow
def test_a_job_that_fails_fails_once(project):
    """And is not done again by another executor."""
    script = project / "workflow/scripts/step.py"
    failing = "if snakemake.rule == 'mesh':\n    open('tried', 'a').write('x')\n    raise ValueError\n"
    script.write_text(f"{script.read_text()}\n{failing}")
    text = snakemake(project, "results/Ref/mesh.msh", "--cores", "2", check=False)
    assert "Error in rule mesh" in text and "ValueError" in text
    assert (project / "tried").read_text() == "x"
