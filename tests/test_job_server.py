"""Jobs in a server that has imported what they need: same output and status, and by themselves without one."""

import os
import pickle
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest
from workflow_runs import wait_until

from r37core.console import job_server, snakemake_run

SCRIPT = """
import os, sys, time
from pathlib import Path
if __name__ == "__main__":
    out, what = sys.argv[1:]
    Path(out).write_text(str(os.getppid()))
    print("said", flush=True)
    print("warned", file=sys.stderr, flush=True)
    if what == "sleep" and not Path(out + ".slept").exists():
        Path(out + ".slept").write_text(str(os.getpid()))
        time.sleep(1000)
    if what == "raise":
        raise ValueError("no")
    if what == "text":
        sys.exit("no")
    if what == "none":
        sys.exit()
    sys.exit(int(what) if what.isdigit() else 0)
"""


LONGEST = 200.0
"""What is waited for (s), however busy the machine is."""


@pytest.fixture
def starter(root, tmp_path):
    """The command of start.py in a folder of scripts that has job.py as one of its own."""
    (tmp_path / "start.py").write_text((root / "workflow/scripts/start.py").read_text())
    return [sys.executable, "-S", "-E", str(tmp_path / "start.py")]


@pytest.fixture
def serve(root, tmp_path, monkeypatch):
    """Starts a server whose first script is a text; returns the script's file and the server's process."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(root / "src"))
    monkeypatch.setenv(job_server.ADDRESS, "")
    Path(".snakemake").mkdir()
    script, servers, said = tmp_path / "job.py", [], []

    def one(text):
        script.write_text(text)
        assert job_server.start(script, Path(sys.executable), said.append)
        servers.append(job_server._KEPT.pop())
        wait_for(Path(os.environ[job_server.ADDRESS]))
        return script, servers[-1]

    one.said = said
    yield one
    for server in servers:
        server.stdin.close()
        server.wait(LONGEST)


@pytest.fixture
def start(serve, starter):
    """Starts a job of the script, as the rule does; `start.server` is the process of the server."""
    _, server = serve(SCRIPT)

    def one(*arguments, out="out", **options):
        command = [*starter, "job.py", out, *arguments]
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)

    one.server, one.said = server, serve.said
    return one


@pytest.fixture
def run_script(starter):
    """Runs a script as a rule does, to its end."""

    def run(*command, **options):
        return subprocess.run([*starter, *command], capture_output=True, text=True, timeout=LONGEST, **options)

    return run


def process_of_the_job():
    """Number of the process of a job that sleeps, once it does."""
    wait_for(slept := Path("out.slept"))
    wait_until(slept.read_text, LONGEST, slept)
    return int(slept.read_text())


def wait_for(path, there=True):
    wait_until(lambda: path.exists() == there, LONGEST, path)


def parent():
    return int(Path("out").read_text())


def parent_of(process):
    return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])


@pytest.mark.parametrize(("what", "status"), [("0", 0), ("3", 3), ("258", 2), ("raise", 1), ("text", 1), ("none", 0)])
def test_output_and_status_are_those_of_the_job(start, what, status):
    job = start(what)
    said, warned = job.communicate(timeout=LONGEST)
    assert (job.returncode, said) == (status, "said\n")
    assert warned.startswith("warned\n")
    assert ("no" in warned) == (what in ("raise", "text"))
    assert parent() == start.server.pid


def test_what_a_script_imports_is_there_before_its_job(start, run_script):
    """Of other scripts than the server's first, and only what it finds; the environment is that of the job."""
    Path("figure.step.py").write_text(
        "import sys, tempfile\nearly = {'wave', 'xml.dom.minidom', 'tempfile'} & set(sys.modules)\n"
        "import wave\nfrom xml.dom import minidom\nprint(sorted(early), tempfile.gettempdir())\nimport missing\n"
    )
    for _ in range(2):
        job = run_script("figure.step.py", env=os.environ | {"TMPDIR": os.getcwd()})
        assert job.stdout == f"['tempfile', 'wave', 'xml.dom.minidom'] {os.getcwd()}\n"
        assert job.returncode == 1 and "ModuleNotFoundError: No module named 'missing'" in job.stderr
    assert start("0").wait(LONGEST) == 0


def test_steps_have_a_process_of_their_own(serve, run_script):
    """What they import is not in the simulations' jobs; where that process is killed steps run by themselves."""
    script, server = serve("import sys\nprint('wave' in sys.modules)\n")
    Path("figure.step.py").write_text("import os, wave\nprint(os.getppid())\n")
    first = int(run_script("figure.step.py").stdout)
    assert parent_of(first) == server.pid
    assert run_script(script).stdout == "False\n"
    assert int(run_script("figure.step.py").stdout) == first
    os.kill(first, signal.SIGKILL)
    wait_for(Path(f"/proc/{first}"), there=False)
    assert int(run_script("figure.step.py").stdout) == os.getpid()
    assert run_script(script).stdout == "False\n"


def test_scripts_of_others_run_by_themselves(start, run_script, tmp_path):
    """What they leave open is closed by Python's own end. Snakemake's copies of ours are ours."""
    text = "import os, sys\nprint(os.getppid())\ndef line():\n    return 'x'\nout = open(sys.argv[1], 'w')\nout.write(line())\n"
    for ours in (False, True):
        folder = str(tmp_path) if ours else "/somewhere/else"
        Path(".snakemake/copy.step.py").write_text(f"__real_file__ = __file__; __file__ = {folder + '/mine.py'!r};\n{text}")
        job = run_script(".snakemake/copy.step.py", "out")
        assert (parent_of(int(job.stdout)) == start.server.pid) if ours else (int(job.stdout) == os.getpid())
        assert ours or Path("out").read_text() == "x"


def test_a_module_is_run_without_the_server(start, root):
    """As Snakemake runs itself for some jobs, with the interpreter that it knows."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "executable", sys.executable)
        snakemake_run.start_scripts_by(root / "workflow/scripts/start.py")
        command = f"{sys.executable} -m calendar 2026 11"
    job = subprocess.run(command, shell=True, capture_output=True, text=True, timeout=LONGEST)
    assert "November 2026" in job.stdout and job.returncode == 0
    assert start.server.poll() is None


def _message(*parts, more=b""):
    text = b"\0".join(map(os.fsencode, parts)) + more
    return len(text).to_bytes(8, "little") + text


NONSENSE = {
    "nothing": (b"", 0),
    "half a length": (b"\1\0", 0),
    "no text": (bytes(8), 2),
    "the longest length": (b"\xff" * 8 + b"x", 2),
    "no number": (_message("/", "many", "job.py"), 2),
    "no job": (_message("/", "0"), 2),
    "a negative number": (_message("/", "-1", "job.py"), 2),
    "no environment": (_message("/", "1", "x", "job.py", "out"), 2),
    "no outputs": (_message("/", "0", "job.py", "out", "0"), 0),
    "one output": (_message("/", "0", "job.py", "out", "0"), 1),
    "more than it said": (_message("/", "0", "job.py", "out", "0") + b"more", 2),
    "an empty script": (_message("/", "0", ""), 2),
    "no UTF-8": (_message("/", "0", "job.py", more=b"\0\xff\xfe"), 2),
}


def test_no_client_ends_the_server_or_keeps_others_waiting_for_ever(start):
    """One stays silent, the others say what start.py does not; after them all a job is done by the server."""
    with socket.socket(socket.AF_UNIX) as silent:
        silent.connect(os.environ[job_server.ADDRESS])
        for text, outputs in NONSENSE.values():
            with socket.socket(socket.AF_UNIX) as client, open(os.devnull, "w") as nowhere:
                client.connect(os.environ[job_server.ADDRESS])
                if outputs:
                    socket.send_fds(client, [text], [nowhere.fileno()] * outputs)
                else:
                    client.sendall(text)
        assert start("3").wait(LONGEST) == 3
        assert parent() == start.server.pid
    assert start.said == []


def test_a_server_that_ends_is_reported_and_leaves_nothing(start, monkeypatch):
    monkeypatch.setattr(job_server, "_STOPPED_S", 0.05)
    folder = Path(os.environ[job_server.ADDRESS]).parent
    start.server.send_signal(signal.SIGSTOP)
    # a job that waits for it is done by itself
    assert start("2").wait(LONGEST) == 2 and parent() == os.getpid()
    wait_for(folder, there=False)
    (line,) = start.said
    assert f"job server (process {start.server.pid}) was stopped or killed" in line and "the same command again" in line


def test_a_server_that_is_stopped_for_a_moment_goes_on(start, monkeypatch):
    monkeypatch.setattr(job_server, "_STOPPED_S", 0.2)
    start.server.send_signal(signal.SIGSTOP)
    start.server.send_signal(signal.SIGCONT)
    assert start("2").wait(LONGEST) == 2 and parent() == start.server.pid
    assert start.said == []


def test_folders_of_servers_that_were_killed_are_removed(serve):
    """And those of living ones stay."""
    _, first = serve(SCRIPT)
    here = Path(os.environ[job_server.ADDRESS]).parent
    deserted = Path(".snakemake/r37_jobs_before")
    deserted.mkdir()
    with socket.socket(socket.AF_UNIX) as killed:
        killed.bind(str(deserted / "socket"))
    serve(SCRIPT)
    assert here.is_dir() and not deserted.exists()
    assert first.poll() is None


def test_only_the_owner_reaches_the_server(start):
    folder = Path(os.environ[job_server.ADDRESS]).parent
    assert folder.stat().st_mode & 0o777 == 0o700


def test_a_server_is_gone_before_its_snakemake(serve, tmp_path):
    """Also one that is busy, or stopped."""
    code = (
        "import os, sys\nfrom pathlib import Path\nfrom r37core.console import job_server\n"
        "job_server._END_S = float(sys.argv[1])\n"
        "assert job_server.start(Path('job.py'), Path(sys.executable), print)\n"
        "os.kill(job_server._KEPT[0].pid, int(sys.argv[2]))\nprint('done')\n"
    )
    Path("job.py").write_text(SCRIPT)
    for seconds, signal_number in ((LONGEST, 0), (0.2, signal.SIGSTOP)):
        arguments = [sys.executable, "-c", code, str(seconds), str(int(signal_number))]
        done = subprocess.run(arguments, capture_output=True, text=True, timeout=LONGEST)
        assert (done.stdout, done.stderr) == ("done\n", "")
        assert list(Path(".snakemake").iterdir()) == []


def test_a_killed_server_is_done_without(start):
    start.server.kill()
    start.server.wait(LONGEST)
    assert start("2").wait(LONGEST) == 2 and parent() == os.getpid()


def test_a_job_that_is_killed_in_the_server_is_done_again_by_itself(start):
    job = start("sleep")
    os.kill(process_of_the_job(), signal.SIGKILL)
    assert job.wait(LONGEST) == 0 and parent() == os.getpid()


def test_a_job_whose_client_is_killed_ends(start):
    job = start("sleep")
    number = process_of_the_job()
    job.kill()
    wait_for(Path(f"/proc/{number}"), there=False)
    # and the server goes on
    assert start("0").wait(LONGEST) == 0


def test_jobs_side_by_side(start):
    jobs = [start("4", out=f"out_{number}") for number in range(30)]
    assert {job.wait(LONGEST) for job in jobs} == {4}
    assert {Path(f"out_{number}").read_text() for number in range(30)} == {str(start.server.pid)}


def test_a_client_that_dies_while_it_asks_leaves_nothing(start):
    """Killed between its first byte and its last."""
    assert start("0").wait(LONGEST) == 0
    with socket.socket(socket.AF_UNIX) as client:
        client.connect(os.environ[job_server.ADDRESS])
        client.sendall((100).to_bytes(8, "little"))
        socket.send_fds(client, [b"o"], [1, 2])
    children = Path(f"/proc/{start.server.pid}/task/{start.server.pid}/children")
    # the process of the steps stays
    wait_until(lambda: len(children.read_text().split()) < 2, LONGEST, children)


def test_modules_of_the_users_folder_are_not_the_servers(start):
    """The server imports what it needs at its start and at the first job."""
    Path("random.py").write_text("raise SystemExit(9)")
    Path("runpy.py").write_text("raise SystemExit(9)")
    job_server.start(Path("job.py").absolute(), Path(sys.executable), print)
    second = job_server._KEPT.pop()
    wait_for(Path(os.environ[job_server.ADDRESS]))
    assert start("0").wait(LONGEST) == 0
    assert parent() == second.pid
    second.stdin.close()
    assert second.wait(LONGEST) == 0


def test_a_folder_without_sockets_has_no_server(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv(job_server.ADDRESS, "of another run")
    job_server.start(tmp_path / "job.py", Path(sys.executable), print)
    assert job_server.ADDRESS not in os.environ


def test_what_jobs_have_in_common_is_loaded_in_the_server(serve, run_script):
    """Before each job, with its arguments; a failure there is not the job's."""
    script, _ = serve(
        "import sys\n"
        "def make_ready(what):\n    sys.ready = [*getattr(sys, 'ready', []), what]\n    int(what)\n"
        "if __name__ == '__main__':\n    print(sys.ready)\n"
    )
    said = [run_script(script, what).stdout for what in ("1", "one", "2")]
    assert said == ["['1']\n", "['1', 'one']\n", "['1', 'one', '2']\n"]


def test_what_a_job_s_parameters_name_is_there_before_it(start, run_script):
    """Of a step, whose script names no module: the line that Snakemake puts before its copy does."""
    parameters = {"step": "r37core.blade.steps.geometry", "draw": "r37core.figures.maps.draw_map", "other": "r37core.none"}
    line = f"import pickle; parameters = pickle.loads({pickle.dumps(parameters, protocol=4)})\n"
    Path("copy.step.py").write_text(f"{line}import sys\nprint(*(name in sys.modules for name in sys.argv[1:]))\n")
    job = run_script("copy.step.py", "r37core.blade.steps", "r37core.figures.maps", "r37core.rom.steps")
    assert job.stdout == "True True False\n", job.stderr
