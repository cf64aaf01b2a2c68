"""Processes of a job that works on several cores, which end with it."""

import ctypes
import multiprocessing
import signal
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import Any

_END_WITH_PARENT = 1
"""Option of Linux: a process gets a signal when the one that forked it ends."""


def end_with_parent() -> None:
    """End this process with the one that forked it."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_END_WITH_PARENT, signal.SIGKILL)


def forked_results(cores: int, calls: Sequence[Callable[[], Any]], what: str = "") -> list[Any]:
    """Results of the calls, in their order, by so many forks of this process. Raises what the first one to fail raises.

    All end with this process, whatever ends it. Raises MemoryError where one was killed.
    """
    forks = min(cores, len(calls))
    if forks <= 1:
        return [call() for call in calls]
    # forks have the calls, which nothing needs to carry to them
    _CALLS[:] = calls
    pool = ProcessPoolExecutor(forks, multiprocessing.get_context("fork"), end_with_parent)
    try:
        return list(pool.map(_result, range(len(calls))))
    except BrokenProcessPool:
        raise MemoryError("a process of this job was killed; what it has done is there for the same command") from None
    finally:
        pool.shutdown(cancel_futures=True)
        _CALLS.clear()


_CALLS: list[Callable[[], Any]] = []


def _result(number: int) -> Any:
    return _CALLS[number]()
