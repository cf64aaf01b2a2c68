"""Failures and warnings of the jobs of a run, kept so that the run can end with them. Light: every job imports it."""

import base64
import contextlib
import errno
import json
import logging
import os
import pickle
import shutil
import sys
import traceback
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import TextIO

from r37core.base.io import FULL_DISK, JOB_LOG, JOB_NEWS, OutputFileError
from r37core.sweep.counts import COUNTS

STOPPED = "stopped; the same command goes on with what is there"
"""Last words of a run that was interrupted."""

_NOTES = "R37_FAILURES"
"""Environment variable that names the file, one for each run: several may go on in one folder."""


@contextlib.contextmanager
def reported(rule: str, log: Path | str, about: str = "") -> Iterator[None]:
    """Send all output to the file `log`; an error ends the process with one clear line, and its traceback goes to the log.

    `about`: what the job is of, for the line.
    """
    with open(log, "w", encoding="utf-8") as stream:
        try:
            with contextlib.redirect_stdout(stream), contextlib.redirect_stderr(stream), _steps_heard(stream):
                yield
        except Exception as error:
            line = f"rule {rule}: {_explained(error)} ({about}details in {log})"
            with contextlib.suppress(OSError):
                traceback.print_exc(file=stream)
                note(line, error)
            show(line, sys.stderr)
            sys.exit(1)


@contextlib.contextmanager
def _steps_heard(stream: TextIO) -> Iterator[None]:
    """Write there what steps say for the log."""
    handler, news, level = logging.StreamHandler(stream), _Shown(), JOB_LOG.level
    JOB_LOG.addHandler(handler)
    JOB_NEWS.addHandler(news)
    JOB_LOG.setLevel(logging.DEBUG)
    try:
        yield
    finally:
        JOB_LOG.removeHandler(handler)
        JOB_NEWS.removeHandler(news)
        JOB_LOG.setLevel(level)


class _Shown(logging.Handler):
    """Handler that shows lines of a job while it works."""

    def emit(self, record: logging.LogRecord) -> None:
        show(record.getMessage(), sys.__stderr__)


def show(line: str, stream: TextIO | None) -> None:
    """Write a line of a job to where messages go, if anywhere, in place of the progress that stands there on a terminal."""
    if stream is not None:
        print(f"\r\x1b[K{line}" if stream.isatty() else line, file=stream)


@contextlib.contextmanager
def printed_warnings(locations: Mapping[str, str]) -> Iterator[None]:
    """Print what a mesh or import is warned of, after the location of its key: in the log, on the screen, when the run ends."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield
    location = next(locations[key] for key in ("mesh", "matrices", "disc") if key in locations)
    for warning in caught:
        print(line := f"{location}: {warning.message}")
        if issubclass(warning.category, UserWarning):
            show(line, sys.__stderr__)
            note(line)


def begin(run: str) -> None:
    """Keep what the jobs of the run of this name report apart from that of others: they inherit where."""
    for variable, what in ((_NOTES, "failures"), (COUNTS, "simulations")):
        file = Path(f".snakemake/r37_{what}_{run}.txt")
        file.unlink(missing_ok=True)
        os.environ[variable] = str(file)


def note(line: str, error: Exception | None = None) -> None:
    """Keep the line for the end of the run; several lines become one, unless some are indented, to be copied as they are.

    `error`: of a failure, kept for a Python call that raises it again.
    """
    file = _file()
    if file is not None and file.parent.is_dir():
        kept = {"line": line if "\n  " in line else line.replace("\n", " ")}
        # an error that cannot be carried is told by its line
        with contextlib.suppress(Exception):
            kept |= {} if error is None else {"error": base64.b64encode(pickle.dumps(error)).decode()}
        with open(file, "a", encoding="utf-8") as stream:
            stream.write(json.dumps(kept) + "\n")


def error_of(failure: dict[str, str]) -> Exception:
    """The error of a failure as `notes` gives it; a RuntimeError with its line where the error could not be carried."""
    with contextlib.suppress(Exception):
        error: Exception = pickle.loads(base64.b64decode(failure["error"]))
        error.add_note(failure["line"])
        return error
    return RuntimeError(failure["line"])


def notes() -> list[dict[str, str]]:
    """Lines kept of this run, in the order of time, each with its error if it has one. They are not kept any longer."""
    file = _file()
    if file is None or not file.exists():
        return []
    kept = list(map(json.loads, file.read_text(encoding="utf-8").splitlines()))
    file.unlink()
    return kept


def taken(most: int = 5) -> list[str]:
    """The lines kept of this run, each once; they are not kept any longer."""
    lines = list(dict.fromkeys(note["line"] for note in notes()))
    more = [f"... and {len(lines) - most} more, see the logs"] if len(lines) > most else []
    return [*lines[:most], *more]


def _file() -> Path | None:
    name = os.environ.get(_NOTES)
    return Path(name) if name else None


def _explained(error: Exception) -> str:
    text = str(error).strip() or type(error).__name__
    if isinstance(error, OutputFileError):
        return text
    full = isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT)
    if full or shutil.disk_usage(".").free < FULL_DISK:
        return f"the disk is full ({text}); free some space and give the same command again"
    if isinstance(error, MemoryError):
        return f"not enough memory ({text}); run fewer jobs at once (--cores), or choose a smaller fidelity level"
    return text


def end_interruptions_in_one_line() -> None:
    """Let an interruption that nothing else takes end in one line; other errors are shown as they were."""
    before = sys.excepthook

    def show(kind: type[BaseException], error: BaseException, traceback: TracebackType | None) -> None:
        if issubclass(kind, KeyboardInterrupt):
            print(STOPPED, file=sys.stderr)
        else:
            before(kind, error, traceback)

    sys.excepthook = show
