"""What r37 knows of Snakemake's inside, each name looked for in it; and one line about thousands of jobs."""

import io
import logging
import os
import re
import signal
import sys
from importlib.metadata import version

import numpy as np
import pytest
from conftest import Terminal
from stubbed_runs import copy_stubbed
from warm_snakemake import started
from workflow_runs import LONGEST, environment, snakemake, wait_until

from r37core import __version__
from r37core.console import failures, snakemake_run
from r37core.console.progress import Progress, change_in_words, quieten
from r37core.sweep import counts
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.status import RunStatus


def test_the_version_is_the_one_that_the_console_was_written_for(root):
    pinned = re.search(r"^snakemake==(.*)$", (root / "envs/lock.txt").read_text(), re.MULTILINE)[1]
    assert {pinned, version("snakemake")} == {snakemake_run.SNAKEMAKE}, (
        f"r37core.console was written for the inside of Snakemake {snakemake_run.SNAKEMAKE}, envs/lock.txt has {pinned}, "
        f"installed is {version('snakemake')}: look through src/r37core/console and the tests here, then set SNAKEMAKE to it"
    )


def test_an_interruption_while_the_rules_are_read_is_one_line(root, capsys, monkeypatch):
    """Before anything else is imported, which takes the first second."""
    shown = []
    monkeypatch.setattr(sys, "excepthook", lambda *error: shown.append(error))
    failures.end_interruptions_in_one_line()
    sys.excepthook(KeyboardInterrupt, KeyboardInterrupt(), None)
    assert (capsys.readouterr().err, shown) == (f"{failures.STOPPED}\n", [])
    sys.excepthook(ValueError, error := ValueError("x"), None)
    assert shown == [(ValueError, error, None)]
    lines = [line for line in (root / "Snakefile").read_text().splitlines() if line and not line.startswith("#")]
    before = lines[: lines.index("failures.end_interruptions_in_one_line()")]
    imported = [line.split()[1] for line in before if line.startswith(("import", "from"))]
    assert imported == ["os", "sys", "importlib.util", "snakemake.exceptions", "r37core.console"]


@pytest.fixture
def clock():
    def clock():
        return clock.now

    clock.now = 0.0
    return clock


def said(progress, event=None, message="", **fields):
    record = logging.LogRecord("snakemake", logging.INFO, "", 0, message, None, None)
    record.__dict__ |= {"event": event, **fields}
    return progress.filter(record)


def simulate(progress, clock, number, blade, output="none.npz"):
    """One simulation of a hundred jobs, which ends as many seconds after the start as its number."""
    clock.now = float(number)
    said(progress, "job_info", "rule simulate", jobid=number, rule_name="simulate", wildcards={"blade": blade}, output=[output])
    said(progress, "job_started", "")
    said(progress, "job_finished", f"Finished jobid: {number}", job_id=number)
    said(progress, "progress", "steps", done=number, total=100)


def test_messages_of_single_jobs_are_kept_back_and_failures_are_not(clock):
    progress = Progress(10, io.StringIO(), clock)
    assert not said(progress, "job_started", "Execute 1 jobs...")
    assert not said(progress, None, "Select jobs to execute...")
    assert not said(progress, None, "")
    assert said(progress, "job_error", "Error in rule simulate")
    assert said(progress, None, "config/config.yaml:3: speeds: found nothing")
    assert said(progress, "run_info", "Job stats")


def test_plain_lines_come_once_a_minute_and_at_the_end(clock):
    stream = io.StringIO()
    progress = Progress(250, stream, clock)
    for number in range(1, 101):
        simulate(progress, clock, number, "Ref" if number <= 60 else "L50")
    lines = stream.getvalue().splitlines()
    assert len(lines) == 3
    simulations = "simulations 100 of about 250 (Ref 60, L50 40); 0 diverged"
    assert lines[-1] == f"jobs 100 of 100; {simulations}; 1.0 a second; 0 s for those known"
    assert "\r" not in stream.getvalue()


def test_of_many_blades_not_all_are_named(clock):
    progress = Progress(2, io.StringIO(), clock)
    for number in range(1, 6):
        simulate(progress, clock, number, f"B{number}")
    assert "(2 blades more, B3 1, B4 1, B5 1)" in progress.line()


def test_on_a_terminal_the_line_renews_itself(clock):
    stream = Terminal()
    progress = Progress(10, stream, clock)
    for number in range(1, 4):
        simulate(progress, clock, number, "Ref")
    assert stream.getvalue().count("\r") == 3
    assert "\n" not in stream.getvalue()
    # a message of its own begins on a line of its own
    assert said(progress, "job_error", "Error in rule simulate")
    assert stream.getvalue().endswith("\n")


def test_a_job_of_the_structure_is_named_when_it_begins(clock):
    """Of these nobody knows how long the rest takes; a plain log has no line of each."""
    stream, log = Terminal(), io.StringIO()
    for progress in (Progress(10, stream, clock), Progress(10, log, clock)):
        for number, rule in enumerate(("geometry", "mesh")):
            said(progress, "job_info", "", jobid=number, rule_name=rule, wildcards={"blade": "Ref"}, output=["mesh.vtu"])
        said(progress, "job_finished", "", job_id=0)
    assert stream.getvalue().endswith("now geometry Ref, mesh Ref") and log.getvalue() == ""
    clock.now = 1.0
    said(progress, "progress", "steps", done=1, total=100)
    assert log.getvalue() == "jobs 1 of 100; 1.0 a second; now mesh Ref\n"


def test_no_run_is_silent(clock):
    """A line comes while jobs are planned, and while one of them takes long, also after simulations."""
    log = io.StringIO()
    progress = Progress(10, log, clock)
    clock.now = 29.0
    progress.beat()
    assert log.getvalue() == ""
    clock.now = 31.0
    progress.beat()
    assert log.getvalue() == "planning the jobs, for 31 s\n"
    simulate(progress, clock, 40, "Ref")
    said(progress, "job_info", "", jobid=1, rule_name="looks", wildcards={"blade": "Ref"}, output=["looks.nc"])
    clock.now = 175.0
    progress.beat()
    assert log.getvalue().splitlines()[-1].endswith("; now looks Ref for 2 min")
    said(progress, "job_finished", "", job_id=1)
    said(progress, "progress", "steps", done=100, total=100)
    clock.now, written = 400.0, log.getvalue()
    progress.beat()
    assert log.getvalue() == written
    log.close()
    progress.beat()


def test_a_rule_that_runs_again_says_once_what_has_changed():
    progress = Progress(0, io.StringIO())
    before = "Params have changed since last execution: Union of exclusive params before and now across all output: "
    for number, (rule, reason) in enumerate(
        [
            ("configuration", f"{before}before: 1 now: 2"),
            ("geometry", f"{before}before: 'round' now: 'blunt'"),
            ("geometry", f"{before}before: 'round' now: 'blunt'"),
            ("response", "Missing output files: response.nc"),
            ("mesh", "Updated input files: fan.msh"),
            ("wear", f"Code has changed since last execution {'x' * 400}"),
        ]
    ):
        said(progress, "job_info", "", jobid=number, rule_name=rule, wildcards={}, output=["a"], reason=reason)
    told = [line for line in progress.stream.getvalue().splitlines() if "again" in line]
    assert told[:2] == ["geometry runs again: 'round' is 'blunt' now", "mesh runs again: Updated input files: fan.msh"]
    assert told[2].startswith("wear runs again: Code has changed") and len(told[2]) < 330 and told[2].endswith("...")


@pytest.mark.parametrize(
    "change, words",
    [
        ("before: {'a': 1.0, 'b': inf, 'c': 2} now: {'a': 1.5, 'b': inf, 'd': 2}", "a was 1.0 and is 1.5; c was 2 and is None"),
        ("before: '0123456789abcdef' now: '123456789abcdef0'", f"code of its step has changed; this is r37 {__version__}"),
        ("before: 3 now: [1]", "3 is [1] now"),
        ("before: <object> now: <object>", "before: <object>"),
        ("before:  now: 3", "before:  now: 3"),
    ],
)
def test_what_has_changed_is_said_in_words(change, words):
    assert change_in_words(change).startswith(words)


def test_diverged_runs_are_counted(clock, tmp_path):
    for name, status in (("a", RunStatus.COMPLETED), ("b", RunStatus.DIVERGED)):
        write_speed({"status": np.array(int(status))}, tmp_path / f"{name}.npz", {})
    (tmp_path / "c.npz").write_text("no archive")
    progress = Progress(10, io.StringIO(), clock)
    for number, name in enumerate("abc", 1):
        simulate(progress, clock, number, "Ref", str(tmp_path / f"{name}.npz"))
    assert "; 1 diverged;" in progress.line()


def test_simulations_of_a_job_of_many_are_counted(clock, tmp_path, monkeypatch):
    monkeypatch.setenv(counts.COUNTS, str(tmp_path / "counts.txt"))
    progress = Progress(10, io.StringIO(), clock)
    simulate(progress, clock, 1, "Ref")
    for status in (RunStatus.COMPLETED, RunStatus.DIVERGED, RunStatus.COMPLETED):
        counts.count_simulation(status)
    assert "simulations 4 of about 10 (Ref 1, members, designs, further runs 3); 1 diverged" in progress.line()


def test_only_the_terminal_s_handler_is_quietened():
    terminal, file = logging.StreamHandler(), logging.StreamHandler()
    terminal.name, file.name = "DefaultStreamHandler", "DefaultLogFileHandler"
    assert quieten([terminal, file], progress := Progress(1))
    assert (terminal.filters, file.filters) == ([progress], [])
    assert not quieten([file], progress)


@pytest.mark.slow
def test_a_run_prints_little_and_its_log_has_everything(root, tmp_path):
    copy_stubbed(root, tmp_path)
    script = tmp_path / "workflow/scripts/step.py"
    diverged = "import numpy\nif snakemake.rule == 'simulate':\n    numpy.savez(open(snakemake.output[0], 'wb'), status=1)\n"
    script.write_text(f"{script.read_text()}\n{diverged}")
    printed = snakemake(tmp_path, "all_blades", "--cores", "2", full_log="")
    assert len(printed.splitlines()) < 66
    # of two jobs at a time either may end first
    assert re.search(r"simulations 12 of about 12 \((Ref 6, CS100 6|CS100 6, Ref 6)\); 12 diverged", printed)
    assert re.search(r"^jobs (\d+) of \1; simulations", printed, re.MULTILINE)
    assert "rule simulate:" not in printed
    logs = list(tmp_path.glob(".snakemake/log/*.log"))
    assert sum(log.read_text().count("rule simulate:") for log in logs) == 12


@pytest.mark.slow
def test_an_interrupted_run_says_how_to_go_on_and_no_error(root, tmp_path):
    copy_stubbed(root, tmp_path)
    script = tmp_path / "workflow/scripts/step.py"
    script.write_text(f"{script.read_text()}\nimport time\nif snakemake.rule == 'simulate':\n    time.sleep(600)\n")
    with started(tmp_path, ("all_blades", "--cores", "1"), environment(tmp_path), LONGEST) as (process, printed):
        wait_until(lambda: list(tmp_path.glob("results/*/*/speed_*.npz")), LONGEST, "a simulation")
        os.killpg(process.pid, signal.SIGINT)
        process.wait()
        text = printed()
    assert failures.STOPPED in text.splitlines() and "WorkflowError" not in text
    # a failure is one
    script.write_text("raise ValueError('broken')")
    assert "WorkflowError" in snakemake(tmp_path, "all_blades", "--cores", "1", check=False)
