"""Number of simulations that a job of many has done: it reports them while it works. Light: every job imports it."""

import os
from collections import Counter

COUNTS = "R37_SIMULATIONS"
"""Environment variable that names the file with the status of each simulation that a job of many has done in this run."""


def count_simulation(status: int) -> None:
    """Add a simulation with this status to those done; nothing outside a run of the workflow."""
    if file := os.environ.get(COUNTS):
        with open(file, "a", encoding="utf-8") as stream:
            stream.write(f"{int(status)}\n")


def counted_simulations() -> Counter[int]:
    """Number of simulations that jobs of many have done in this run, by status."""
    file = os.environ.get(COUNTS)
    if file is None or not os.path.exists(file):
        return Counter()
    with open(file, encoding="utf-8") as stream:
        return Counter(int(line) for line in stream.read().split())
