"""The readings side by side, as a Markdown table."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from r37core.published import DIRECT_PEAK, INTERACTIONS

from . import measures as read
from .check import Check, number, score
from .reading_list import READINGS
from .validation import Runs, reading_checks


def readings_table(readings: Mapping[str, Runs], yield_stress: float) -> str:
    """Lined peaks of every reading, largest error, drops; then direct contact; then how many checks are met."""
    peaks = [f"{one.blade} 1B/{one.engine_order}: {one.peak:g}" for one in INTERACTIONS]
    head = ["reading", *peaks, "largest error", "drops", "first yield at 1717: 40"]
    head += [f"direct, largest rms: {DIRECT_PEAK:g}", "drop after: 1344", "first yield there: 90", "met"]
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    lines += ["| " + " | ".join(_cells(name, runs, yield_stress)) + " |" for name, runs in readings.items()]
    return "\n".join(lines) + "\n"


def _cells(name: str, runs: Runs, yield_stress: float) -> list[str]:
    checks = {check.name: check for check in reading_checks(runs, yield_stress)}
    speeds = [_peak(runs, one.name) for one in INTERACTIONS]
    errors = [check.error for name, check in checks.items() if name.endswith(": peak")]
    drops = [check for name, check in checks.items() if name.endswith("drop after the peak")]
    largest = f"{100 * max(errors):.2g}%" if np.isfinite(max(errors)) else f"{sum(np.isinf(errors))} missed"
    lined = [*speeds, largest, score(drops), _ours(checks, "Ref lined at 1717: first yield")]
    direct = [
        _ours(checks, name)
        for name in ("direct: largest rms", "direct: last speed before the drop", "direct at 1344: first yield, shortly before")
    ]
    return [READINGS[name].what, *lined, *direct, score(list(checks.values()))]


def _peak(runs: Runs, place: str) -> str:
    """Peak speed as text; at the window's last speed the branch may go on."""
    if place not in runs:
        return ""
    speed = read.peak_speed(runs[place])
    return ("≥ " if speed == float(runs[place]["speed"][-1]) else "") + number(speed)


def _ours(checks: Mapping[str, Check], name: str) -> str:
    return checks[name].shown if name in checks else ""
