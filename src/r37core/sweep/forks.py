"""Processes of a job that works on several cores, and how many of its simulations are done. Light: consoles import it."""

import ctypes
import json
import multiprocessing
import os
import signal
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from typing import Any

COUNTS = "R37_SIMULATIONS"
"""Environment variable that names the file with a line for each simulation that a job of this run has done."""

_END_WITH_PARENT = 1
"""Option of Linux: a process gets a signal when the one that forked it ends."""


def end_with_parent() -> None:
    """End this process with the one that forked it."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_END_WITH_PARENT, signal.SIGKILL)


def forked_results(cores: int, calls: Sequence[Callable[[], Any]], what: str = "") -> list[Any]:
    """Results of the calls, in their order, by so many forks of this process. Raises what the first one to fail raises.

    All end with this process, whatever ends it. Raises BrokenProcessPool where one was killed.
    """
    forks = min(cores, len(calls))
    if forks <= 1:
        return [call() for call in calls]
    pool = ProcessPoolExecutor(forks, multiprocessing.get_context("fork"), end_with_parent)
    try:
        return list(pool.map(_called, calls))
    finally:
        pool.shutdown(cancel_futures=True)


def _called(call: Callable[[], Any]) -> Any:
    return call()


def count_simulation(name: str, status: int) -> None:
    """Add a simulation to those done, in the sweep of this name and with this status; nothing outside a run of the workflow."""
    if file := os.environ.get(COUNTS):
        with open(file, "a", encoding="utf-8") as stream:
            stream.write(json.dumps([name, int(status)]) + "\n")


def counted_simulations() -> Counter[int]:
    """Number of simulations that jobs have done in this run, by status."""
    file = os.environ.get(COUNTS)
    if file is None or not os.path.exists(file):
        return Counter()
    with open(file, encoding="utf-8") as stream:
        # a last line may not be whole yet
        return Counter(json.loads(line)[1] for line in stream if line.endswith("\n"))
