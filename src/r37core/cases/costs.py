"""What some work costs this process."""

from __future__ import annotations

import resource
import time


class Stopwatch:
    """Adds up CPU and wall seconds of this process over the blocks it is used for."""

    def __init__(self) -> None:
        self.cpu = self.wall = 0.0

    def __enter__(self) -> None:
        self._start = time.process_time(), time.perf_counter()

    def __exit__(self, *_: object) -> None:
        self.cpu += time.process_time() - self._start[0]
        self.wall += time.perf_counter() - self._start[1]


def peak_memory() -> float:
    """Largest memory (bytes) of this process so far."""
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)
