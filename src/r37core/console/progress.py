"""One line about a run of thousands of jobs, in place of several from each of them.

A filter on Snakemake's own handler. Its official ways were tried with 9.27 and do not serve. `quiet` takes the messages of jobs
from the log file and from a dry run too. A plugin of `--logger` must be a top-level package of its own, replaces the handler
with its colours, must stand in every profile, and where its package is not found a run ends with Snakemake's list of options.
"""

import atexit
import contextlib
import logging
import re
import sys
import threading
import time
from ast import literal_eval
from collections import Counter
from collections.abc import Callable, Collection
from pathlib import Path
from typing import Any, TextIO

from r37core import __version__
from r37core.base.io import InputFileError
from r37core.sweep.counts import counted_simulations
from r37core.time_integration.speed_file import read_status
from r37core.time_integration.status import RunStatus

QUIET_EVENTS = frozenset({"job_info", "job_started", "job_finished", "progress", "shellcmd", "resources_info"})
"""Messages of Snakemake about every job; failures and warnings are none of these."""

HANDLER = "DefaultStreamHandler"
"""Name of Snakemake's handler of messages on the terminal."""

_CHATTER = (
    "Select jobs to execute",
    "Execute ",
    "DAG of jobs will be updated",
    "Updating checkpoint dependencies",
    "Touching output",
)
"""Beginnings of messages without an event that come with every job."""

_ON_TERMINAL_S, _ELSEWHERE_S = 0.5, 60.0
"""Shortest time between two lines: one that renews itself, or plain ones."""

_SILENT_S, _SILENT_ELSEWHERE_S = 10.0, 30.0
"""Longest time without a line, on a terminal and elsewhere, and how long a job runs before the line says for how long."""


_INFINITE, _HASH = re.compile(r"\binf\b"), re.compile("[0-9a-f]{16,}")
_MOST_CHANGES, _LONGEST_CHANGE = 3, 300
"""Rules that are named as they run again, and letters of what has changed."""


class Progress(logging.Filter):
    """A filter for the handler of Snakemake's messages that keeps those about single jobs back and writes a line instead.

    `expected`: about how many simulations there are, those of earlier runs included. The line goes to `stream`: renewed in
    place if that is a terminal, and now and then as a line of its own if it is not. Snakemake's log file has everything. While
    `beating` the line also comes when Snakemake says nothing for long.
    """

    def __init__(self, expected: int, stream: TextIO | None = None, clock: Callable[[], float] = time.monotonic):
        super().__init__()
        self.expected, self.stream, self.clock = expected, stream or sys.stderr, clock
        self._jobs: dict[Any, tuple[str, str, str, float]] = {}
        self._simulated, self._again = Counter[str](), set[str]()
        self._diverged = self._done = self._known = 0
        self._began: float | None = None
        self._made, self._written, self._open = clock(), -1e9, False
        self._ended, self._lock = threading.Event(), threading.RLock()

    def filter(self, record: logging.LogRecord) -> bool:
        """True where Snakemake's own handler should write the record."""
        event, message = str(getattr(record, "event", None) or ""), record.getMessage().strip()
        passes = bool(message) and event not in QUIET_EVENTS and not (not event and message.startswith(_CHATTER))
        with self._lock:
            self._take(event, record)
            if passes:
                self._close_line()
        return passes

    def _take(self, event: str, record: logging.LogRecord) -> None:
        self._began = self.clock() if self._began is None else self._began
        if event == "job_info":
            output: Collection[str] = getattr(record, "output", None) or [""]
            blade = (getattr(record, "wildcards", None) or {}).get("blade", "")
            about = (record.rule_name, blade, str(next(iter(output))), self.clock())  # type: ignore[attr-defined]
            self._jobs[record.jobid] = about  # type: ignore[attr-defined]
            self._tell_change(record.rule_name, str(getattr(record, "reason", "")))  # type: ignore[attr-defined]
            if not self._simulated and self.stream.isatty():
                # what takes half a minute is named when it begins, not when it has ended
                self._write(immediately=True)
        elif event == "job_finished":
            rule, blade, output, _ = self._jobs.pop(record.job_id, ("", "", "", 0.0))  # type: ignore[attr-defined]
            if rule == "simulate":
                self._simulated[blade] += 1
                with contextlib.suppress(InputFileError):
                    self._diverged += read_status(Path(output)) == RunStatus.DIVERGED
        elif event == "progress":
            self._done, self._known = record.done, record.total  # type: ignore[attr-defined]
            self._write(immediately=record.done == record.total, last=record.done == record.total)  # type: ignore[attr-defined]

    def _tell_change(self, rule: str, reason: str) -> None:
        """Say once what has changed where jobs of a rule run again."""
        changes = [part for part in reason.split("; ") if "changed since" in part or part.startswith("Updated input")]
        # the file with the configuration changes with every key
        if changes and rule not in {"configuration", *self._again} and len(self._again) < _MOST_CHANGES:
            self._again.add(rule)
            self._close_line()
            text = change_in_words(" ".join(changes[0].split()).rpartition("across all output: ")[2])
            self.stream.write(f"{rule} runs again: {text[:_LONGEST_CHANGE]}{'...' * (len(text) > _LONGEST_CHANGE)}\n")

    def line(self) -> str:
        """The line of progress now."""
        spent = self.clock() - (self.clock() if self._began is None else self._began)
        rate = self._done / spent if spent > 0.0 else 0.0
        parts = [f"jobs {self._done} of {self._known}"] if self._known else []
        of_many = counted_simulations()
        if total := self._simulated.total() + of_many.total():
            blades = [*self._simulated.items(), *([("members, designs, further runs", of_many.total())] if of_many else [])]
            shown = ", ".join(f"{blade} {number}" for blade, number in blades[-3:])
            more = f"{len(blades) - 3} blades more, " if len(blades) > 3 else ""
            diverged = self._diverged + of_many[RunStatus.DIVERGED]
            parts += [f"simulations {total} of about {self.expected} ({more}{shown})", f"{diverged} diverged"]
        if rate > 0.0:
            parts.append(f"{rate:.1f} a second")
        if rate > 0.0 and (self._simulated or self._done == self._known):
            # jobs before the first simulation take a hundred times as long as those after it
            parts.append(f"{_duration((self._known - self._done) / rate)} for those known")
        if now := self._now():
            parts.append(f"now {', '.join(now)}")
        return "; ".join(parts) or f"planning the jobs, for {_duration(self.clock() - self._made)}"

    def _now(self) -> list[str]:
        """The last two jobs before the first simulation; then those that have run for long."""
        running = []
        for rule, blade, _, began in list(self._jobs.values()):
            spent = self.clock() - began
            named = f"{rule} {blade}".strip()
            if spent >= _SILENT_S:
                running.append(f"{named} for {_duration(spent)}")
            elif not self._simulated:
                running.append(named)
        return running[-2:]

    def beating(self) -> None:
        """Write the line whenever there was none for long, until the process ends."""
        atexit.register(self._ended.set)
        while not self._ended.wait(1.0):
            self.beat()

    def beat(self) -> None:
        """Write the line if there was none for long."""
        # a terminal that is gone, or a stream that is closed, ends no run
        with self._lock, contextlib.suppress(OSError, ValueError):
            silent = _SILENT_S if self.stream.isatty() else _SILENT_ELSEWHERE_S
            waiting = bool(self._jobs) or not self._known
            if waiting and not self._ended.is_set() and self.clock() - max(self._written, self._made) >= silent:
                self._write(immediately=True)

    def _write(self, immediately: bool, last: bool = False) -> None:
        terminal = self.stream.isatty()
        now = self.clock()
        if not immediately and now - self._written < (_ON_TERMINAL_S if terminal else _ELSEWHERE_S):
            return
        self._written = now
        self.stream.write(f"\r\x1b[K{self.line()}" if terminal else f"{self.line()}\n")
        self.stream.flush()
        self._open = terminal
        if last:
            self._close_line()

    def _close_line(self) -> None:
        if self._open:
            self.stream.write("\n")
            self._open = False


def change_in_words(change: str) -> str:
    """Parameters of a job that have changed, of Snakemake's `before: ... now: ...`; another text as it is.

    Of mappings only values that differ count. A hash stands for code.
    """
    match = re.fullmatch("before: (.*) now: (.*)", change)
    try:
        before, now = (literal_eval(f"[{re.sub(_INFINITE, '1e999', part)}]") for part in match.groups()) if match else ([], [])
    except (SyntaxError, ValueError):
        return change
    if any(_HASH.fullmatch(str(each)) for each in now):
        return f"code of its step has changed; this is r37 {__version__}"
    parts = []
    for old, new in zip(before, now, strict=False):
        if isinstance(old, dict) and isinstance(new, dict):
            keys = [key for key in {**old, **new} if old.get(key) != new.get(key)]
            parts += [f"{key} was {old.get(key)!r} and is {new.get(key)!r}" for key in keys]
        else:
            parts.append(f"{old!r} is {new!r} now")
    return "; ".join(parts) or change


def quieten(handlers: Collection[logging.Handler], progress: Progress) -> bool:
    """Let `progress` stand before Snakemake's messages on the terminal; whether there was such a handler."""
    terminal = [handler for handler in handlers if handler.name == HANDLER]
    for handler in terminal:
        handler.addFilter(progress)
    if terminal:
        threading.Thread(target=progress.beating, daemon=True).start()
    return bool(terminal)


def _duration(seconds: float) -> str:
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"
