"""The Python call that has started this run of Snakemake: it gets events as lines of JSON in place of messages."""

import contextlib
import json
import logging
import os
import signal
import sys
import threading
from typing import Any, Self, TextIO

CALLER = "R37_CALLER"
"""Environment variable with the number of the file descriptor that events are written to; its jobs do not have it."""


class Caller(logging.Filter):
    """A filter for Snakemake's handler that sends to `stream` what the call shows, and keeps all messages back.

    Events: `job` (its rule and wildcards, when it begins), `progress` (done, total), `message` (of an error) and, from
    `failed`, `failure`. The run is interrupted when its standard input ends, which the call holds.
    """

    def __init__(self, stream: TextIO):
        super().__init__()
        self._stream = stream
        threading.Thread(target=_end_with_caller, daemon=True).start()

    @classmethod
    def current(cls) -> Self | None:
        """The caller of this process; None where a person has started it."""
        number = os.environ.pop(CALLER, None)
        return None if number is None else cls(open(int(number), "w", encoding="utf-8"))

    def filter(self, record: logging.LogRecord) -> bool:
        """Nothing passes."""
        event: Any = record
        kind = getattr(record, "event", None)
        if kind == "job_info":
            self._send("job", rule=event.rule_name, wildcards=dict(event.wildcards or {}))
        elif kind == "progress":
            self._send("progress", done=event.done, total=event.total)
        elif record.levelno >= logging.ERROR and kind != "job_error":
            self._send("message", text=record.getMessage())
        return False

    def failed(self, failures: list[dict[str, str]]) -> None:
        """Send what the jobs of this run noted of their failures (`failures.notes`)."""
        for failure in failures:
            self._send("failure", **failure)

    def _send(self, event: str, **about: Any) -> None:
        # a call that is gone ends this run by its standard input
        with contextlib.suppress(OSError):
            print(json.dumps({"event": event, **about}), file=self._stream, flush=True)


def _end_with_caller() -> None:
    while os.read(sys.stdin.fileno(), 1):
        pass
    os.kill(os.getpid(), signal.SIGINT)
