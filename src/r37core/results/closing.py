"""Closing lines of a run: names, counts, the largest stress, where nothing touched. Light: Snakemake's start imports it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy import ndarray

from .limits import beyond_limits, reasons_beyond_limits


def remarks_on_diverged(linear: Sequence[str]) -> list[str]:
    """A line on runs of linear blades that diverged. `linear`: their blades and scenes in words."""
    remark = (
        f"{', '.join(linear)}: runs diverged, as friction can feed a linear motion without bound: structure.kinematics: "
        "quadratic bounds it (docs/large_motion.md); a smaller friction.coefficient shows whether that is the cause"
    )
    return [remark] if linear else []


def remarks_on_limits(runs: Mapping[Any, Any], prefix: str = "") -> list[str]:
    """A line on runs beyond the model's limits, with the reasons; `runs`: as of reasons_beyond_limits."""
    beyond = counted(int(beyond_limits(runs).sum()), "run")
    reasons = reasons_beyond_limits(runs)
    return [f"{prefix}beyond the model's limits in {beyond}: {'; '.join(reasons.values())}"] if reasons else []


def counted(number: int, name: str) -> str:
    """A number of things with their name: 1 run-up, 2 run-ups."""
    return f"{number} {name}{'s' * (number != 1)}"


def interaction_title(mode: object, engine_order: Any) -> str:
    """Title: 1B/4, of a combination 7-5/6 or 5+7/26; without a mode the engine order, or neither. A cell can be NaN."""
    order = "" if str(engine_order) in ("", "None", "nan") else f"{float(engine_order):.0f}"
    if isinstance(mode, str) and mode:
        return f"{mode}/{order}"
    return f"engine order {order}" if order else "a peak of its own"


def lining_texts(runs: Mapping[tuple[str, str], Mapping[str, Any]]) -> list[str]:
    """A line for each scene: what its lining resists with at the tip, and what the tips themselves do.

    `runs`: blade and scene -> numbers of time_integration.kept_numbers.
    """
    lines = []
    for scene in dict.fromkeys(scene for _, scene in runs):
        blades = [numbers for (_, name), numbers in runs.items() if name == scene]
        spans = {name: _span([numbers[name] for numbers in blades]) for name in blades[0]}
        percent = _span([100.0 * numbers["lined_tip_share"] for numbers in blades])
        lines.append(
            f"{scene}: stiffness of the lining at the tip {spans['lining_elastic_stiffness']} N/m, "
            f"{spans['lining_plastic_stiffness']} while it wears, on {percent}% of the tip's length; of the "
            f"blade there {spans['tip_stiffness']} N/m"
        )
    return lines


def extremes(rows: Any) -> tuple[Any, Any]:
    """Rows of a ranking that may be dangerous at the fewest speeds, and those that may be so at the most.

    `rows`: of one scene and contact. None is surely better than the first, none surely worse than the last; a blade whose
    bracket overlaps both is among both.
    """
    return rows[rows["rank_lowest"] == 1], rows[rows["rank_highest"] == len(rows)]


def _span(values: Sequence[Any]) -> str:
    """The smallest and the largest of some values, or the one that they are."""
    ends = dict.fromkeys(f"{end(values):.3g}" for end in (min, max))
    return " to ".join(ends)


def remarks_on_contact(runs: Sequence[tuple[str, ndarray]]) -> list[str]:
    """A line on all runs without a contact force at any speed, whose zeros are no result.

    `runs`: blade and scene in words, and the largest normal force (N) at each speed, NaN for a speed that was not run.
    """
    apart = [run for run, force in runs if np.isfinite(force).any() and not np.any(force > 0.0)]
    remark = (
        f"{', '.join(apart)}: the tip touched nothing at any speed, so all numbers are zero; casing.clearance_m, casing.lobes "
        "and casing.amplitude_m or casing.amplitude_clearances say where it can"
    )
    return [remark] if apart else []
