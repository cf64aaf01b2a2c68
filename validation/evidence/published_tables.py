"""Tables of docs/validation.md and README: published numbers next to ours, ranges, modelling choices."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from published import BLADES, INTERACTIONS, REFERENCE

from r37core.base.dataset_file import read_dataset
from r37core.results.measures import peak_speed

from .checks import Check, number, score
from .pages import write_table
from .published_checks import Runs, structure_checks, survey_checks, window_checks
from .published_ranges import Judged, counts, judge
from .published_runs import in_windows, runs_of, swept
from .published_windows import ALL_CHOICES, ALL_MEMBERS, CHOICES, INSIDE, narrow, source, wide

GROUPS = {
    "shape: areas, volume": r"^(area|volume)",
    "Campbell speeds of 1B": r": Campbell$",
    "dynamic clearance of 1B and 1T": r"dynamic clearance",
    "speeds of the largest rms with lining": r"1B/\d: peak$",
    "drop after them, lobes of the wear there": r"1B/\d: (drop|lobes)",
    "Ref with lining: stress, width, wear": r"^Ref lined(?!, 750|: response)|^Ref 1B/4: width",
    "Ref in direct contact, and both scenes": r"^direct|^at \d+: ",
    "other blades against Ref at their peaks": r"at its peak: |^stress at the peak|^variants at their peaks",
    "whole range of speeds": r"750 to 2000|torsion|^CS100 has",
}
"""Kinds of published numbers -> pattern of their names."""

SUMMED = {
    "shape, Campbell speeds": r"^(area|volume)|: Campbell$",
    "dynamic clearances": r"dynamic clearance",
    "interactions: speed, drop, wear lobes": r"1B/\d: (peak$|drop|lobes)",
    "stress, wear, bare casing, other blades": r"^(?!area|volume|.*dynamic clearance|.*1B/\d: (Campbell|peak|drop|lobes))",
}
"""The same in the few rows of README."""

_LONGEST = 12
"""Rows of a table that stands in a page."""


def all_checks(runs: Runs, survey: Runs, geometry: str, campbells: Sequence[str]) -> list[Check]:
    """Every published number: `runs` in the windows, `survey` over all speeds."""
    diagrams = dict(zip(BLADES, map(read_dataset, campbells), strict=True))
    return structure_checks(read_dataset(geometry), diagrams) + window_checks(runs) + survey_checks(survey, runs)


def checks(input: Any, output: Any, params: Any) -> None:
    """All published numbers next to ours, those that differ, and counts by kind. Inputs: campbells, geometry."""
    swept_all = swept(source("standard").responses)
    survey = {
        "Ref_lined": swept_all[REFERENCE, True],
        "Ref_direct": swept_all[REFERENCE, False],
        "CS100_lined": swept_all["CS100", True],
    }
    ours, standard = (all_checks(runs_of(name), survey, input.geometry, input.campbells) for name in ("paper", "standard"))
    write_table(*checks_table(ours, standard), output.table)
    write_table(*differences(ours, standard), output.differences)
    write_table(*kinds(ours, standard), output.kinds)
    write_table(*summary(ours), output.summary)


Table = tuple[list[str], list[list[str]]]


def by_error(several: Sequence[Check]) -> list[Check]:
    """Checks in the order of tables: what differs first, by falling error; what is published nowhere last."""
    return sorted(several, key=lambda check: (check.published is None, check.agrees, -check.error))


def checks_table(ours: Sequence[Check], standard: Sequence[Check]) -> Table:
    """Every number at the published step and at `standard`."""
    other = {check.name: check for check in standard}
    head = ["what", "unit", "published", "ours", "error", "agrees", "at standard", "error at standard", "agrees at standard"]
    rows = []
    for check in by_error(ours):
        same = other.get(check.name)
        cells = [check.name, check.unit, number(check.published), check.shown, check.percent, check.verdict]
        rows.append([*cells, *([same.shown, same.percent, same.verdict] if same else ["", "", ""])])
    return head, rows


def differences(ours: Sequence[Check], standard: Sequence[Check]) -> Table:
    """The numbers that differ at the published step."""
    other = {check.name: check for check in standard}
    rows = [
        [check.name, number(check.published), check.shown, check.percent, other[check.name].shown]
        for check in by_error(ours)
        if not check.agrees
    ]
    return ["what", "published", "ours", "error", "ours at standard"], rows[:_LONGEST]


def kinds(ours: Sequence[Check], standard: Sequence[Check]) -> Table:
    """How many numbers of each kind agree at the published step and at `standard`, and the largest error of those that do."""
    rows = []
    for name, pattern in {**GROUPS, "all": ""}.items():
        chosen, other = _of_kind(ours, pattern), _of_kind(standard, pattern)
        rows.append([name, score(chosen), _largest_error(chosen), score(other)])
    return ["published", "agree", "largest error of these", "agree at standard"], rows


def summary(ours: Sequence[Check]) -> Table:
    """The same at the published step alone, in few rows."""
    chosen = {name: _of_kind(ours, pattern) for name, pattern in {**SUMMED, "all": ""}.items()}
    return ["published", "agree"], [[name, score(several)] for name, several in chosen.items()]


def _of_kind(several: Sequence[Check], pattern: str) -> list[Check]:
    return [check for check in several if check.published is not None and re.search(pattern, check.name)]


def _largest_error(several: Sequence[Check]) -> str:
    """Of the numbers that agree, as text."""
    return max((check for check in several if check.agrees and check.percent), key=lambda check: check.error).percent


def choices(input: Any, output: Any, params: Any) -> None:
    """Modelling choices, each varied once: all columns, and a few for the page."""
    varied = choices_runs()
    head, rows = choices_table(varied)
    write_table(head, rows, output.table)
    shown = [head.index(name) for name in ("choice", "peaks within 0.6%", "drops", *SHORT, "agree")]
    write_table([head[at] for at in shown], [[row[at] for at in shown] for row in rows], output.short)


def choices_runs() -> dict[str, Runs]:
    """Runs of every choice in words, the first as shipped: the same speeds of the run with all of them."""
    words, standard = CHOICES | INSIDE, runs_of("standard")
    shipped = in_windows(swept(source("standard").responses), narrow, 4.0)
    shipped = {window: with_history(run, standard.get(window)) for window, run in shipped.items()}
    return {"as shipped": shipped} | {words[name.removeprefix("choice_")]: runs_of(name) for name in ALL_CHOICES}


def with_history(run: Any, other: Any) -> Any:
    """A response with the stress histories of another one of the same blade and scene."""
    if other is None or "max_von_mises_history" not in other:
        return run
    run = run.drop_dims("history_speed", errors="ignore")
    return run.assign(max_von_mises_history=other["max_von_mises_history"])


OF_CHOICES = {
    "first yield at 1717 (revolution)": "Ref lined at 1717: first yield",
    "direct: largest rms (rad/s)": "direct: largest rms, normal and tangential together",
    "direct: drop after (rad/s)": "direct: last speed before the drop",
    "direct: first yield at 1344 (revolution)": "direct at 1344: first yield, shortly before",
}
"""Column of the table of choices -> name of its check."""

SHORT = ("direct: largest rms (rad/s)", "direct: first yield at 1344 (revolution)")


def choices_table(varied: Mapping[str, Runs]) -> Table:
    """Lined peaks (rad/s) of every choice, how many agree, drops; then direct contact; then how many checks agree."""
    head = ["choice", *(f"{row.label} (rad/s)" for row in INTERACTIONS), "peaks within 0.6%", "largest error", "drops"]
    return [*head, *OF_CHOICES, "agree"], [choice_cells(words, runs) for words, runs in varied.items()]


def choice_cells(words: str, runs: Runs) -> list[str]:
    """Row of a choice."""
    found = {check.name: check for check in window_checks(runs) if check.published is not None}
    peaks = [check for name, check in found.items() if name.endswith(": peak")]
    drops = [check for name, check in found.items() if name.endswith("drop after the peak")]
    worst = max(check.error for check in peaks)
    largest = f"{100 * worst:.2g}%" if np.isfinite(worst) else f"{sum(np.isinf(check.error) for check in peaks)} without a peak"
    others = [found[name].shown if name in found else "" for name in OF_CHOICES.values()]
    speeds = [_peak(runs[row.name]) for row in INTERACTIONS]
    return [words, *speeds, score(peaks), largest, score(drops), *others, score(found.values())]


def _peak(run: Any) -> str:
    """Peak speed as text; at the window's last speed the branch may go on."""
    speed = peak_speed(run)
    return ("at least " if speed == float(run["speed"][-1]) else "") + number(speed)


def ranges(input: Any, output: Any, params: Any) -> None:
    """Range of every number over the members: all, those that differ or lie outside, and how many."""
    shipped, standard = window_checks(runs_of("paper")), runs_of("standard")
    runs = in_windows(swept(source("standard").responses), wide, 4.0)
    nominal = window_checks({window: with_history(run, standard[window]) for window, run in runs.items()})
    judged = judge(shipped, nominal, [window_checks(runs_of(name)) for name in ALL_MEMBERS])
    write_table(*ranges_table(judged), output.table)
    head, rows = ranges_table([row for row in judged if not (row.shipped.agrees and row.inside)][:_LONGEST])
    write_table(_in_short(head), map(_in_short, rows), output.short)
    write_table(
        ["published numbers and statements", "how many"], [[name, str(count)] for name, count in counts(judged)], output.counts
    )


def _in_short(row: list[str]) -> list[str]:
    """The row without its unit and the nominal run."""
    what, _, published, ours, _, several, inside = row
    return [what, published, ours, several, inside]


def ranges_table(judged: Sequence[Judged]) -> Table:
    """Numbers with their range: first what differs, outside the range before inside."""
    head = ["what", "unit", "published", "ours", "nominal", "range", "inside"]
    rows = []
    for row in sorted(judged, key=lambda row: (row.shipped.agrees, row.inside)):
        check, nominal = row.shipped, row.nominal.shown if row.nominal else ""
        rows.append([check.name, check.unit, number(check.published), check.shown, nominal, row.shown, row.verdict])
    return head, rows
