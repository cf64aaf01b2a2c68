"""Ctrl-C while Snakemake reads the rules: before it has a place of its own for it. Light: imported before all else."""

from __future__ import annotations

import sys
from types import TracebackType


def in_one_line() -> None:
    """Let an interruption that nothing else takes end in one line; other errors are shown as they were."""
    before = sys.excepthook

    def show(kind: type[BaseException], error: BaseException, traceback: TracebackType | None) -> None:
        if issubclass(kind, KeyboardInterrupt):
            print("interrupted before the first job", file=sys.stderr)
        else:
            before(kind, error, traceback)

    sys.excepthook = show
