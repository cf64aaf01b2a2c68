"""Speeds at which the published numbers are looked for. Light: the plan reads it."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, floor
from typing import Any

from published import BLADES, DIRECT_PEAK, INTERACTIONS, QUIET, REFERENCE, PublishedInteraction

LINED, DIRECT = "abradable", "direct"
"""The benchmark's scenes."""

BARE = "Ref_direct"
"""Name of the window of direct contact. Those with lining have the names of the interactions, as `Ref_4`."""

REACH = 0.05
"""How far a window reaches above the published Campbell speed, as a share of it."""

CHOICES = {
    "perturbed": "friction 0.1% larger",
    "cylinder": "cylindrical casing",
    "form": "other friction: vector with lining, constant on the bare casing",
    "bars_0_8mm": "bars 0.8 mm wide",
    "bars_1_25mm": "bars 1.25 mm wide",
    "yield_mpa": "yield stress of the lining 1.5 MPa",
}
"""Choices that validation/published.yaml varies, by the end of the scenes' names, in words."""

BARE_CHOICES = ("perturbed", "cylinder", "form")
"""Choices that concern direct contact, too."""

ELSEWHERE = (850.0, 1000.0, 1100.0, 1200.0, 1300.0, 1400.0, 1500.0, 1600.0, 1717.0, 1800.0, 1900.0)
"""Speeds (rad/s) of direct contact outside its window."""

SURVEY = [float(speed) for speed in range(750, 2001, 10)]
"""Speeds (rad/s) over the whole range, of three responses."""


COMPARED = ("Ref_4", "CS100_4")
"""Interactions whose widths above yield the paper compares."""


def grid(centre: float, below: float, above: float, step: float) -> list[float]:
    """Multiples of `step` (rad/s) about `centre`, from `below` to `above` it."""
    first, last = ceil(below / step - 1e-9), floor(above / step + 1e-9)
    return [centre + number * step for number in range(first, last + 1)]


def window(row: PublishedInteraction) -> list[float]:
    """Every 2 rad/s from the published Campbell speed to 5% above it."""
    return grid(row.campbell, 0.0, REACH * row.campbell, 2.0)


def paper_window(row: PublishedInteraction) -> list[float]:
    """Speeds of the window about the published peak, of the variants every second; all where the paper compares widths."""
    speeds = window(row)[:: 1 if row.blade == REFERENCE else 2]
    return [speed for speed in speeds if row.name in COMPARED or -0.012 <= speed / row.peak - 1.0 <= 0.016]


def narrow(row: PublishedInteraction) -> list[float]:
    """Every 4 rad/s about the published peak, for comparisons of choices."""
    return [speed for speed in window(row)[::2] if -0.008 <= speed / row.peak - 1.0 <= 0.012]


def bare(step: float) -> list[float]:
    """Speeds of direct contact: about its published peak, and some elsewhere."""
    return sorted({*ELSEWHERE, DIRECT_PEAK + 1.0, *grid(DIRECT_PEAK, -20.0, 28.0, step)})


def rule(blade: str, scenes: Sequence[str], *several: Sequence[float]) -> dict[str, Any]:
    """Speeds of a blade in some scenes, as an entry of `speeds_for`."""
    return {"blades": [blade], "scenes": list(scenes), "speeds": sorted({speed for speeds in several for speed in speeds})}


def paper_speeds() -> dict[str, Any]:
    """Keys of the run at the published time step."""
    lined = [rule(blade, [LINED], *map(paper_window, rows), [QUIET]) for blade, rows in _interactions().items()]
    return {"speeds": [QUIET], "speeds_for": [rule(REFERENCE, [DIRECT], bare(2.0)), *lined]}


def standard_speeds() -> dict[str, Any]:
    """Keys of the run at level `standard`: windows, the whole range of three responses, and choices about the peaks."""
    rules = [
        rule(REFERENCE, [DIRECT], bare(2.0), SURVEY),
        rule(REFERENCE, [f"{DIRECT}_{name}" for name in BARE_CHOICES], bare(4.0)),
    ]
    for blade, rows in _interactions().items():
        rules.append(rule(blade, [f"{LINED}_{name}" for name in CHOICES], *map(narrow, rows), [QUIET]))
        rules.append(rule(blade, [LINED], *map(window, rows), [QUIET], SURVEY if blade in (REFERENCE, "CS100") else []))
    return {"speeds": [QUIET], "speeds_for": rules}


def _interactions() -> dict[str, list[PublishedInteraction]]:
    return {blade: [row for row in INTERACTIONS if row.blade == blade] for blade in BLADES}


def responses(folder: str, lined: str = LINED, direct: str | None = DIRECT) -> list[str]:
    """Files of all blades with lining and, with `direct`, of the reference blade without, in the folder of a run."""
    files = [f"{folder}/{blade}/{lined}/response.nc" for blade in BLADES]
    return files + ([f"{folder}/{REFERENCE}/{direct}/response.nc"] if direct else [])


def choice_responses(folder: str, choice: str) -> list[str]:
    """Files of a choice."""
    return responses(folder, f"{LINED}_{choice}", f"{DIRECT}_{choice}" if choice in BARE_CHOICES else None)
