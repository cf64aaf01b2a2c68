"""What r37 knows of Snakemake's inside: the version it was written for, and each name that it uses, looked for in it."""

import inspect
import re
import sys
from dataclasses import fields
from importlib.metadata import version
from pathlib import Path

import pytest
from snakemake import api, jobs, logging, modules, script
from snakemake.persistence import file as persistence
from snakemake.scheduling import job_scheduler
from snakemake.settings import types
from snakemake_interface_logger_plugins.common import LogEvent

from r37core.console import failures, progress, snakemake_run
from r37core.console.lock import _LOCKS


def test_the_version_is_the_one_that_the_console_was_written_for(root):
    pinned = re.search(r"^snakemake==(.*)$", (root / "envs/lock.txt").read_text(), re.MULTILINE)[1]
    assert {pinned, version("snakemake")} == {snakemake_run.SNAKEMAKE}, (
        f"r37core.console was written for the inside of Snakemake {snakemake_run.SNAKEMAKE}, envs/lock.txt has {pinned}, "
        f"installed is {version('snakemake')}: look through src/r37core/console and the tests here, then set SNAKEMAKE to it"
    )


@pytest.mark.parametrize(
    ("where", "names"),
    [
        (types.ConfigSettings, {"configfiles", "config", "replace_workflow_config"}),
        (types.OutputSettings, {"dryrun", "verbose"}),
        (types.DAGSettings, {"targets"}),
        (types.DeploymentSettings, {"deployment_method"}),
    ],
)
def test_settings_have_their_names(where, names):
    assert names <= {field.name for field in fields(where)}
    section = where.__name__.removesuffix("Settings").lower() + "_settings"
    assert section in api.Workflow.__annotations__
    assert section in inspect.getsource(snakemake_run)


def test_what_is_asked_of_snakemake_is_there():
    names = ("is_main_process", "basedir", "current_basedir", "local_exec", "modifier", "scheduler")
    assert all(hasattr(api.Workflow, name) for name in names)
    assert hasattr(modules.WorkflowModifier, "is_main_snakefile")
    assert types.DeploymentMethod.CONDA.name == "CONDA"
    # where the lock lies that is lifted
    assert f'os.path.join(self.path, "{_LOCKS.name}")' in inspect.getsource(persistence)
    assert _LOCKS.parent == Path(".snakemake")
    assert f'"{progress.HANDLER}"' in inspect.getsource(logging.LoggerManager._default_streamhandler)
    assert {str(event) for event in LogEvent} >= progress.QUIET_EVENTS


@pytest.mark.parametrize(
    ("source", "event", "names"),
    [
        (jobs, "JOB_INFO", ("jobid=", "rule_name=", "wildcards=", "output=")),
        (job_scheduler, "JOB_FINISHED", ("job_id=",)),
        (job_scheduler, "PROGRESS", ("done=", "total=")),
    ],
)
def test_messages_have_the_fields_that_the_line_is_made_of(source, event, names):
    about = inspect.getsource(source).split(f"event=LogEvent.{event}", 1)[1][:700]
    assert [name for name in names if name not in about] == []


def test_the_limit_that_a_run_takes_away_is_still_there():
    """Of jobs per second: the console sets it to None, which must not become a name that nobody reads."""
    scheduler = job_scheduler.JobScheduler
    assert all("job_rate_limiter" in function.__code__.co_names for function in (scheduler.__init__, scheduler.schedule))


def test_scripts_are_started_with_the_interpreter_s_name_as_it_stands():
    """The console quotes it, once: a Snakemake that quotes it too would start nothing."""
    about = inspect.getsource(script.PythonScript)
    assert "py_exec = sys.executable" in about
    assert '"{py_exec} {fname:q}"' in about


def test_an_interruption_while_the_rules_are_read_is_one_line(root, capsys, monkeypatch):
    """Before anything else is imported, which takes the first second."""
    shown = []
    monkeypatch.setattr(sys, "excepthook", lambda *error: shown.append(error))
    failures.end_interruptions_in_one_line()
    sys.excepthook(KeyboardInterrupt, KeyboardInterrupt(), None)
    assert (capsys.readouterr().err, shown) == ("interrupted before the first job\n", [])
    sys.excepthook(ValueError, error := ValueError("x"), None)
    assert shown == [(ValueError, error, None)]
    lines = [line for line in (root / "Snakefile").read_text().splitlines() if line and not line.startswith("#")]
    before = lines[: lines.index("failures.end_interruptions_in_one_line()")]
    assert before == ["import os", "import sys", "from r37core.console import failures"]
