"""Every speed of one blade and scene in one process: what speeds that refine themselves are judged against."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from r37core.time_integration.speed_file import write_speed


def run_one_by_one(run: Callable[[float], Mapping[str, np.ndarray]], speeds: Sequence[float]) -> Iterator[Path]:
    """File of each of the `speeds` (rad/s) in turn, with the arrays of `run(speed)`; a file is gone when the next is asked for.

    Thousands of runs in one process cost no start-up and leave no files; for `write_response`, which reads one at a time.
    """
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "speed.npz"
        for number, speed in enumerate(speeds, 1):
            write_speed(run(speed), file, {})
            yield file
            if number % 100 == 0:
                print(f"{number} of {len(speeds)} speeds", flush=True)
