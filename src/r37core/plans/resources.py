"""How much memory and time a rule's jobs need, from what was measured (validation/benchmarks/resources.py)."""

from __future__ import annotations

import csv
from functools import cache
from itertools import groupby
from operator import itemgetter
from pathlib import Path
from typing import Any

import numpy as np

from r37core.config import Settings

MEASURED = Path(__file__).with_name("resources.csv")
"""Columns rule, size, memory_mb, time_s; the rows of a rule by ascending size."""

PER_RESPONSE = frozenset({"response", "map_figure"})
"""Rules whose jobs grow with the number of simulations of one blade and scene."""

PER_SWEEP = frozenset({"sweep_dataset", "summary", "explorer", "response_figure", "response_overview"})
"""Rules whose jobs grow with the number of all simulations; those of the rest grow with the mesh."""

MARGIN = 1.5
"""Of memory, for what differs between blades; time has four times as much, because machines differ more."""

SMALLEST_MB, SHORTEST_MIN = 300, 5


@cache
def read_measured() -> dict[str, list[list[float]]]:
    """What was measured: rule -> rows of [size, MB, s]."""
    with open(MEASURED, newline="", encoding="utf-8") as stream:
        _, *rows = csv.reader(stream)
    return {rule: [[float(cell) for cell in row[1:]] for row in group] for rule, group in groupby(rows, itemgetter(0))}


def estimated(rows: list[list[float]], size: float) -> tuple[float, float]:
    """Memory (MB) and time (s) at `size`: straight lines between the measured ones, the last one's prolonged."""
    sizes, *columns = np.array(rows, float).T
    if size > sizes[-1] and len(sizes) > 1:
        slopes = [max((column[-1] - column[-2]) / (sizes[-1] - sizes[-2]), 0.0) for column in columns]
        memory, time = (column[-1] + slope * (size - sizes[-1]) for column, slope in zip(columns, slopes, strict=True))
    else:
        memory, time = (np.interp(size, sizes, column) for column in columns)
    return float(memory), float(time)


class Needs:
    """What the rules ask of a cluster, at the size that `settings` have; nothing for a rule that was not measured."""

    def __init__(self, settings: Settings, runs: int):
        self._nodes, self._runs = settings.fidelity.mesh.nodes, runs
        self._responses = len(settings.speed_plans)

    def of(self, rule: str) -> dict[str, Any]:
        """`mem_mb` and `runtime` (minutes) of a job of the rule."""
        rows = read_measured().get(rule)
        if not rows:
            return {}
        memory, time = estimated(rows, self._size(rule))
        return {
            "mem_mb": max(SMALLEST_MB, round(MARGIN * memory)),
            "runtime": max(SHORTEST_MIN, round(4.0 * MARGIN * time / 60.0)),
        }

    def _size(self, rule: str) -> float:
        if rule in PER_RESPONSE:
            return self._runs / self._responses
        return self._runs if rule in PER_SWEEP else self._nodes
