"""Published numbers beside ours as shipped, and the modelling choices side by side."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from r37core.dataset_file import read_dataset
from r37core.figures.maps import draw_spectral_map
from r37core.results.measures import peak_speed
from validation.published import DIRECT_PEAK, INTERACTIONS, REFERENCE
from validation.studies.checks import Check, number, ran, score, validation_table, with_histories
from validation.studies.tables import markdown_table

from .cases import CHOICES, HISTORIES, SHIPPED, SURVEY, VARIED
from .figures import draw_blades, draw_choices, draw_histories, draw_reference, draw_stress
from .validation import Runs, choice_checks, convergence_checks, shipped_checks

_DIRECT = (
    "direct: largest rms, normal and tangential together",
    "direct: last speed before the drop",
    "direct at 1344: first yield, shortly before",
)
"""Checks of direct contact in the table of choices."""


def report(responses: Mapping[str, xr.Dataset], files: Any, values: Mapping[str, Any]) -> dict[str, Any]:
    """Tables and pictures."""
    runs = runs_of(responses)
    campbells = campbells_of(files, values)
    shipped, survey, varied = runs[SHIPPED], runs[SURVEY], {name: runs[name] for name in (SHIPPED, *VARIED)}
    checks = shipped_checks(read_dataset(files.geometry), campbells, runs)
    made: dict[str, Any] = {
        "validation": validation_table(checks, convergence_checks(campbells, runs)),
        "table": choices_table(varied),
        "picture": draw_choices(varied),
        "reference": draw_reference(survey, shipped),
        "blades": draw_blades(shipped),
        "stress": draw_stress(shipped),
        "histories": draw_histories(shipped),
    }
    for window in ("Ref_lined", "Ref_direct"):
        made[f"spectrum_{window[4:]}"] = draw_spectral_map(survey[window], campbells[REFERENCE]["level"], window)
    return made


def campbells_of(files: Any, values: Mapping[str, Any]) -> dict[str, dict[str, xr.Dataset]]:
    """Campbell diagrams by blade and mesh."""
    campbells: dict[str, dict[str, xr.Dataset]] = {}
    for (blade, mesh), file in zip(values["campbells"], files.campbells, strict=True):
        campbells.setdefault(blade, {})[mesh] = read_dataset(file)
    return campbells


def runs_of(responses: Mapping[str, xr.Dataset]) -> dict[str, dict[str, xr.Dataset]]:
    """Responses by choice and window; the reference blade's histories are with its 1B/4."""
    runs: dict[str, dict[str, xr.Dataset]] = {}
    for name, response in responses.items():
        choice, window = name.split("/")
        runs.setdefault(choice, {})[window] = ran(response, name)
    for several in runs.values():
        if HISTORIES in several:
            main = INTERACTIONS[0].name
            several[main] = with_histories(several[main], several.pop(HISTORIES))
    return runs


def choices_table(choices: Mapping[str, Runs]) -> str:
    """Lined peaks of every choice, largest error, drops; then direct contact; then how many checks agree."""
    peaks = [f"{interaction.label}: {interaction.peak:g}" for interaction in INTERACTIONS]
    head = ["choice", *peaks, "largest error", "drops", "first yield at 1717: 40"]
    head += [f"direct, largest rms: {DIRECT_PEAK:g}", "drop after: 1344", "first yield there: 90", "agree"]
    return markdown_table(head, (_cells(name, runs) for name, runs in choices.items()))


def _cells(name: str, runs: Runs) -> list[str]:
    checks = {check.name: check for check in choice_checks(runs)}
    speeds = [_peak(runs, interaction.name) for interaction in INTERACTIONS]
    errors = [check.error for name, check in checks.items() if name.endswith(": peak")]
    drops = [check for name, check in checks.items() if name.endswith("drop after the peak")]
    largest = f"{100 * max(errors):.2g}%" if np.isfinite(max(errors)) else f"{sum(np.isinf(errors))} differ"
    lined = [*speeds, largest, score(drops), _ours(checks, "Ref lined at 1717: first yield")]
    direct = [_ours(checks, name) for name in _DIRECT]
    return [CHOICES[name].what, *lined, *direct, score(list(checks.values()))]


def _peak(runs: Runs, window: str) -> str:
    """Peak speed as text; at the window's last speed the branch may go on."""
    if window not in runs:
        return ""
    speed = peak_speed(runs[window])
    return ("≥ " if speed == float(runs[window]["speed"][-1]) else "") + number(speed)


def _ours(checks: Mapping[str, Check], name: str) -> str:
    return checks[name].shown if name in checks else ""
