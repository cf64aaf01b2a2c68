"""Tables of docs/validation.md and README: published numbers next to ours, and modelling choices."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from published import BLADES, REFERENCE

from r37core.base.dataset_file import read_dataset

from .checks import Check, number, score
from .published_checks import PROTOTYPE, Runs, structure_checks, survey_checks, window_checks
from .published_runs import choice_runs, level_runs, responses_of
from .published_windows import CHOICES
from .tables import write_table

GROUPS = {
    "shape, Campbell speeds": r"^(area|volume)|: Campbell$",
    "statements on dynamic clearance": r"dynamic clearance",
    "interactions: speed, drop, wear lobes": r"1B/\d: (peak$|drop|lobes)",
    "stress, wear, bare casing, other blades": r"^(?!area|volume|.*dynamic clearance|.*1B/\d: (Campbell|peak|drop|lobes))",
}
"""Kinds of published numbers -> pattern of their names."""

UNPUBLISHED = "apart: slopes of an unpublished prototype"
"""Row of what is no published number."""

Table = tuple[list[str], list[list[str]]]


def checks(input: Any, output: Any, params: Any) -> None:
    """All published numbers next to ours, those that differ, and counts.

    Inputs: paper, standard, models, campbells, geometry.
    """
    swept = responses_of(input.standard)
    survey = {"Ref_lined": swept[REFERENCE, True], "Ref_direct": swept[REFERENCE, False], "CS100_lined": swept["CS100", True]}
    diagrams = dict(zip(BLADES, map(read_dataset, input.campbells), strict=True))
    structure = structure_checks(read_dataset(input.geometry), diagrams)
    levels = []
    for level in ("paper", "standard"):
        runs = level_runs(input[level], input.models, level)
        levels.append(structure + window_checks(runs) + survey_checks(survey, runs))
    write_table(*checks_table(*levels), output.validation_checks)
    write_table(*differences(*levels), output.validation_differences)
    write_table(*counts(*levels), output.published_summary)


def by_error(several: Iterable[Check]) -> list[Check]:
    """Checks in the order of tables: what is published first, and of that what differs, by falling error."""
    return sorted(several, key=lambda check: (PROTOTYPE in check.name, check.agrees, -check.error))


def checks_table(ours: Sequence[Check], standard: Sequence[Check]) -> Table:
    """Every number at the published step and at `standard`."""
    other = {check.name: check for check in standard}
    head = ["what", "unit", "published", "ours", "error", "agrees", "at standard", "error at standard", "agrees at standard"]
    rows = []
    for check in by_error(ours):
        same = other[check.name]
        cells = [check.name, check.unit, number(check.published), check.shown, check.percent, check.verdict]
        rows.append([*cells, same.shown, same.percent, same.verdict])
    return head, rows


def differences(ours: Sequence[Check], standard: Sequence[Check]) -> Table:
    """The numbers that differ at the published step."""
    other = {check.name: check.shown for check in standard}
    rows = [
        [check.name, number(check.published), check.shown, check.percent, other[check.name]]
        for check in by_error(ours)
        if not check.agrees
    ]
    return ["what", "published", "ours", "error", "ours at standard"], rows


def counts(ours: Sequence[Check], standard: Sequence[Check]) -> Table:
    """How many numbers of each kind agree at the published step and at `standard`, and the largest error of those that do."""
    levels, patterns = (ours, standard), {**GROUPS, "all": ""}
    several = {name: [_of_kind(checks, pattern) for checks in levels] for name, pattern in patterns.items()}
    several[UNPUBLISHED] = [[check for check in checks if PROTOTYPE in check.name] for checks in levels]
    rows = [[name, score(chosen), _largest_error(chosen), score(other)] for name, (chosen, other) in several.items()]
    return ["published", "agree", "largest error of these", "agree at standard"], rows


def _of_kind(several: Sequence[Check], pattern: str) -> list[Check]:
    return [check for check in several if PROTOTYPE not in check.name and re.search(pattern, check.name)]


def _largest_error(several: Sequence[Check]) -> str:
    """Of the numbers that agree, as text; nothing where all are statements."""
    numbers = [check for check in several if check.agrees and check.percent]
    return max(numbers, key=lambda check: check.error).percent if numbers else ""


def choices(input: Any, output: Any, params: Any) -> None:
    """Modelling choices, each varied once. Inputs: standard, models, and the responses of each choice."""
    varied = {"standard": "as shipped", **CHOICES}
    write_table(*choices_table({words: choice_runs(input[name], input.models) for name, words in varied.items()}), output.table)


OF_CHOICES = {
    "first yield at 1717": "Ref lined at 1717: first yield",
    "bare: largest rms (rad/s)": "direct: largest rms, normal and tangential together",
    "bare: first yield at 1344": "direct at 1344: first yield, shortly before",
}
"""Column of the table of choices -> name of its check."""


def choices_table(varied: Mapping[str, Runs]) -> Table:
    """Lined peaks of every choice that agree, their largest error, drops; then direct contact; then how many checks agree."""
    head = ["choice", "peaks within 0.6%", "largest error", "drops", *OF_CHOICES, "agree"]
    return head, [choice_cells(words, runs) for words, runs in varied.items()]


def choice_cells(words: str, runs: Runs) -> list[str]:
    """Row of a choice."""
    several = {check.name: check for check in window_checks(runs)}
    peaks = [check for name, check in several.items() if name.endswith(": peak")]
    drops = [check for name, check in several.items() if name.endswith("drop after the peak")]
    worst = max(check.error for check in peaks)
    largest = f"{100 * worst:.2g}%" if np.isfinite(worst) else f"{sum(np.isinf(check.error) for check in peaks)} without a peak"
    others = [several[name].shown if name in several else "" for name in OF_CHOICES.values()]
    return [words, score(peaks), largest, score(drops), *others, score(several.values())]
