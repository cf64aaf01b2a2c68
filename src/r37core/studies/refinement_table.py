"""The study `refinement` as tables in Markdown."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from .refinement import TOLERANCE, Comparison, Outcome


def refinement_table(outcomes: Mapping[str, Mapping[tuple[str, str], Outcome]], every: Mapping[tuple[str, str], int]) -> str:
    """What each way to choose speeds finds. `outcomes`: way -> (blade, scene) -> outcome, the first way refines itself.

    `every`: number of speeds of the whole grid of each blade and scene.
    """
    lines = [
        f"Interactions above yield that are found at all, and with peak and width within {TOLERANCE:g} rad/s; runs of each way "
        "to choose speeds.",
        "",
        "| blade | scene | whole grid | " + " | ".join(outcomes) + " |",
        "|---|---|---|" + "---|" * len(outcomes),
    ]
    first = next(iter(outcomes.values()))
    for blade, scene in first:
        number = len(first[blade, scene].interactions)
        cells = [_cell(ways[blade, scene]) for ways in outcomes.values()]
        lines.append(f"| {blade} | {scene} | {number} in {every[blade, scene]} runs | " + " | ".join(cells) + " |")
    totals = [_total(list(ways.values())) for ways in outcomes.values()]
    number = sum(len(one.interactions) for one in first.values())
    lines += [f"| all | | {number} in {sum(every.values())} runs | " + " | ".join(totals) + " |", ""]
    missed = {place: [one for one in outcome.interactions if not one.same] for place, outcome in first.items()}
    lines += ["Missed, or off by more:" if any(missed.values()) else "Nothing is missed.", ""]
    return "\n".join([*lines, *_missed_lines(missed)]).rstrip() + "\n"


def _cell(outcome: Outcome) -> str:
    found, same = (sum(getattr(one, name) for one in outcome.interactions) for name in ("found", "same"))
    rounds = f" in {outcome.rounds} rounds" if outcome.rounds > 1 else ""
    return f"{found} found, {same} the same, {outcome.runs} runs{rounds}"


def _total(outcomes: Sequence[Outcome]) -> str:
    together = [one for outcome in outcomes for one in outcome.interactions]
    runs = sum(outcome.runs for outcome in outcomes)
    return f"{sum(one.found for one in together)} found, {sum(one.same for one in together)} the same, {runs} runs"


def _missed_lines(missed: Mapping[tuple[str, str], Sequence[Comparison]]) -> list[str]:
    if not any(missed.values()):
        return []
    lines = [
        "| blade | scene | interaction | peak, width (rad/s) | largest stress (GPa) | found peak, width |",
        "|---|---|---|---|---|---|",
    ]
    for (blade, scene), several in missed.items():
        for one in several:
            order = "" if one.engine_order is None or math.isnan(one.engine_order) else f"/{one.engine_order}"
            name = f"{one.mode}{order}" if one.mode else f"no crossing, order {one.engine_order}"
            found = f"{one.found_peak:g}, {one.found_width:.1f}" if one.found else "none"
            lines.append(f"| {blade} | {scene} | {name} | {one.peak:g}, {one.width:.1f} | {1e-9 * one.stress:.2f} | {found} |")
    return lines
