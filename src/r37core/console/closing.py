"""What a finished run says: what was found, where to look, how long it took."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from pathlib import Path

from r37core.results.interaction_title import interaction_title
from r37core.time_integration.status import RunStatus


def closing_lines(results: Path, began: float, ended: float, remarks: Iterable[str] = ()) -> list[str]:
    """What the folder `results` has: interactions, runs that diverged, `remarks` on them, where to look, and how long it took.

    None if it is older than the run's start. `began` and `ended`: times in s, as file times are.
    """
    summary = results / "summary.csv"
    if not summary.exists() or summary.stat().st_mtime < began:
        return []
    with open(summary, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    where = f"look at {results}/explorer.html (any browser), {summary}, {results}/figures/"
    return [_found(rows) + _diverged(results / "rms.nc"), *remarks, where, _took(ended - began)]


def _found(rows: list[dict[str, str]]) -> str:
    if not rows:
        return "found no interaction"
    above = [row for row in rows if _number(row, "width_above_yield_rad_s") > 0.0 or _number(row, "certain_length_rad_s") > 0.0]
    text = f"found {len(rows)} interaction{'s' * (len(rows) > 1)}, {len(above)} of them above yield"
    if above:
        worst = max(above, key=lambda row: _number(row, "max_von_mises_pa"))
        if (largest := _number(worst, "max_von_mises_pa")) > 0.0:
            title = interaction_title(worst["mode"], worst["engine_order"])
            text += (
                f"; the largest stress {1e-9 * largest:.2f} GPa, {worst['blade']} in {worst['scene']} "
                f"at {float(worst['max_von_mises_speed_rad_s']):.6g} rad/s ({title})"
            )
    return text


def _number(row: dict[str, str], column: str) -> float:
    """0 for an empty cell."""
    return float(row[column] or 0.0)


def _diverged(file: Path) -> str:
    """How many runs diverged; nothing where none did."""
    # not at every start of Snakemake
    import netCDF4

    try:
        with netCDF4.Dataset(file) as rms:
            status = rms["status"][:]
    except OSError:
        # not there, or no dataset, which who reads it is told
        return ""
    diverged, runs = (status == RunStatus.DIVERGED).sum(), (status != RunStatus.NOT_RUN).sum()
    return f"; {diverged} of {runs} runs diverged" if diverged else ""


def _took(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return "took " + (f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s" if minutes else f"{rest} s")
