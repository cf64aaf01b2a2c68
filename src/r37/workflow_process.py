"""Snakemake in a process of its own that runs the workflow in a folder, and tells this one how far it is."""

import contextlib
import json
import os
import selectors
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import r37core
from r37core.base.io import InputFileError
from r37core.config import ConfigError, Settings
from r37core.console.caller import CALLER
from r37core.console.failures import error_of
from r37core.plans.stages import structure_stages
from r37core.plans.sweep_plan import Sweep

from .stages import LOGGER, job_bar, simulations_in_words

_OPTIONS = (
    *("--workflow-profile", "none", "--nocolor", "--rerun-incomplete", "--rerun-triggers"),
    *("mtime", "params", "input", "software-env", "--executor", "warm", "--scheduler", "greedy"),
    *("--scheduler-subsample", "100", "--max-checksum-file-size", "1GB"),
)
"""Options of profiles/default, but without going on after a failure: a call ends with the first."""

_END_S = 1.5
"""How long an interrupted run may take to end by itself."""


def run_workflow(settings: Settings, folder: Path, targets: Sequence[str], cores: int) -> None:
    """Make the `targets` of the study in `folder`, which has these settings. Raises what its first failed job raises."""
    reading, writing = os.pipe()
    command = [sys.executable, "-P", "-m", "snakemake", *targets, "--cores", str(cores), *_OPTIONS]
    with open(reading, encoding="utf-8") as events:
        process = start(command, folder, _environment(writing), writing)
        os.close(writing)
        try:
            report = _Report(settings)
            for kind, line in _lines(process, events.fileno()):
                report.take(kind, line)
            status = process.wait()
        finally:
            report.bar.close()
            _end(process)
    if status:
        raise report.error(folder)


def start(command: Sequence[str], folder: Path, environment: Mapping[str, str], events: int) -> subprocess.Popen[bytes]:
    """Start the command in a session of its own, with pipes to its input and errors, and the file descriptor `events`."""
    return subprocess.Popen(
        command,
        cwd=folder,
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        pass_fds=[events],
        start_new_session=True,
    )


def _environment(events: int) -> dict[str, str]:
    # the package that this process has imported, wherever it lies
    source = str(Path(r37core.__file__).parent.parent)
    path = os.pathsep.join([source, *filter(None, [os.environ.get("PYTHONPATH")])])
    return {**os.environ, CALLER: str(events), "PYTHONPATH": path}


def _lines(process: subprocess.Popen[bytes], events: int) -> Iterator[tuple[str, str]]:
    """Lines of the process until it has ended, each an `event` or a `text`."""
    assert process.stderr is not None
    with selectors.DefaultSelector() as selector:
        selector.register(events, selectors.EVENT_READ, "event")
        selector.register(process.stderr.fileno(), selectors.EVENT_READ, "text")
        rest = {"event": b"", "text": b""}
        while selector.get_map():
            for key, _ in selector.select():
                part = os.read(key.fd, 2**16)
                *lines, rest[key.data] = (rest[key.data] + part).split(b"\n") if part else [rest[key.data], b""]
                yield from ((key.data, line.decode("utf-8", "replace")) for line in lines if line.strip())
                if not part:
                    selector.unregister(key.fd)


def _end(process: subprocess.Popen[bytes]) -> None:
    """Be sure that no process of the run is left: its jobs end with it, and a run that is interrupted with this call."""
    with contextlib.suppress(ProcessLookupError):
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(_END_S)
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    for stream in (process.stdin, process.stderr):
        assert stream is not None
        stream.close()


class _Report:
    """Events of a run so far: shown where somebody watches, and the error that it ends with."""

    def __init__(self, settings: Settings):
        self._settings = settings
        self._stages = structure_stages(Sweep(settings))
        self._told: set[str] = set()
        self._failures: list[dict[str, str]] = []
        self._messages: list[str] = []
        self._texts: list[str] = []
        self.bar = job_bar()

    def take(self, kind: str, line: str) -> None:
        """Take a line of the process."""
        if kind == "text":
            self._texts.append(line)
            # jobs say something to the user in lines of their own
            LOGGER.info("%s", line)
            return
        event = json.loads(line)
        match event.pop("event"):
            case "job":
                self._begun(**event)
            case "progress":
                self.bar.total = event["total"]
                self.bar.update(event["done"] - self.bar.n)
            case "message":
                self._messages.append(event["text"])
            case "failure":
                self._failures.append(event)

    def _begun(self, rule: str, wildcards: Mapping[str, str]) -> None:
        """Say once what a stage does for a blade, and how many simulations a blade and scene have."""
        blade, scene = wildcards.get("blade", ""), wildcards.get("scene", "")
        if rule in self._stages:
            line = f"{blade}: {self._stages[rule].title}"
        elif rule == "simulate":
            plan = self._settings.speed_plans[blade, scene]
            number = f"at least {len(plan.certain)}" if plan.refined else str(len(plan.certain))
            line = simulations_in_words(self._settings, blade, scene, number)
        else:
            return
        if line not in self._told:
            self._told.add(line)
            LOGGER.info("%s", line)

    def error(self, folder: Path) -> Exception:
        """The error that the run has ended with; without a message its last twenty lines."""
        if self._failures:
            return error_of(self._failures[0])
        text = "\n".join(dict.fromkeys(self._messages)) or "\n".join(self._texts[-20:]) or "Snakemake ended without a word"
        kind, _, reason = text.partition(":\n")
        if kind == ConfigError.__name__:
            return ConfigError(reason)
        if kind == "MissingRuleException":
            return ConfigError(f"targets: {reason}")
        if "cannot be locked" in text:
            return ConfigError(f"folder: found {folder}, where another run goes on; allowed: another folder, or to wait for it")
        return InputFileError(text) if InputFileError.__name__ in text else RuntimeError(text)


def snakemake_targets(targets: Any) -> list[str]:
    """Names of rules, or files, as Snakemake takes them. Raises ConfigError."""
    several = [targets] if isinstance(targets, str) else targets
    named = isinstance(several, Sequence) and all(isinstance(name, str) and name and name[0] != "-" for name in several)
    if not (several and named):
        raise ConfigError(f'targets: found {targets!r}; allowed: names of rules or files, as in targets=["tables", "exports"]')
    return [*several]
