"""What the columns of the tables are called and mean: the one source of docs/results.md and of the explorer's column heads."""

from __future__ import annotations

from dataclasses import dataclass, replace

from . import ranges
from .exceedance import CERTAIN, POSSIBLE
from .measures import DROP_WITHIN


@dataclass(frozen=True)
class Word:
    """A column in words: a short `title`, its `meaning`, and the `unit` it is shown in: the SI value times `factor`."""

    title: str
    meaning: str
    unit: str = ""
    factor: float = 1.0


_SPEED = "rad/s"
_MM, _MPA, _PERCENT = ("mm", 1e3), ("MPa", 1e-6), ("%", 100.0)
_REVOLUTIONS = "revolutions in the last half of a run"
_POSSIBLE = f"more than {POSSIBLE:.0%} of the {_REVOLUTIONS} are above yield"
_CERTAIN = f"more than {CERTAIN:.0%} of the {_REVOLUTIONS} are above yield"

INTERACTIONS = {
    "blade": Word("blade", "name of the blade in the configuration"),
    "scene": Word("scene", "name of what the blade meets: casing, lining or none, friction, damping"),
    "mode": Word(
        "mode", "of the crossing that explains the peak (first bending 1B, first torsion 1T, second bending 2B), or empty"
    ),
    "engine_order": Word(
        "engine order", "frequency over rotor speed at that crossing; without a crossing the strongest order of the spectrum"
    ),
    "direction": Word("direction", "in which the rms has its peak there: normal to the casing, tangential, or both"),
    "campbell_speed_rad_s": Word(
        "Campbell speed", "speed of the crossing in the Campbell diagram; empty without a crossing", _SPEED
    ),
    "peak_speed_rad_s": Word("peak speed", "speed of the largest motion of the leading edge within the interaction", _SPEED),
    "shift_rad_s": Word("shift", "peak speed less Campbell speed; empty without a crossing", _SPEED),
    "peak_rms_normal_m": Word("normal rms", "rms of the leading edge normal to the casing, at the peak speed", *_MM),
    "peak_rms_tangential_m": Word(
        "tangential rms", "rms of the leading edge tangential to the casing, at the peak speed", *_MM
    ),
    "drop": Word(
        "lost above the peak",
        f"share of the motion that is lost within {DROP_WITHIN:g} rad/s above the peak; empty where it only rises",
        *_PERCENT,
    ),
    "first_yield_speed_rad_s": Word(
        "first speed above yield",
        "lowest speed of the interaction at which the stress is above yield; empty where none is",
        _SPEED,
    ),
    "width_above_yield_rad_s": Word(
        "width above yield",
        "range from the first to the last speed above yield, ends interpolated; 0 for none, empty without stress",
        _SPEED,
    ),
    "share_above_yield": Word(
        "part of the width above yield",
        "how much of that range is above yield, empty without a range: "
        "near the end of a branch the motion is chaotic, and single speeds lie below",
        *_PERCENT,
    ),
    "max_von_mises_pa": Word(
        "largest stress, last revolution",
        "largest von Mises stress in the last revolution at any speed of the interaction, which need not be the peak speed",
        *_MPA,
    ),
    "max_von_mises_speed_rad_s": Word("at speed", "speed of the interaction at which the stress is largest", _SPEED),
    "stress_region": Word("stress region", "where on the blade the stress is looked for, as in `stress.nc`"),
    "max_wear_m": Word(
        "largest wear", "largest wear of the lining at any speed of the interaction; empty without a lining", *_MM
    ),
    "worn_through_share": Word(
        "worn through",
        "largest share of the circumference, at any speed of the interaction, at which the tip has reached the casing behind "
        "the lining; its wear is there less than its thickness, whose elastic part springs back; empty without a lining",
        *_PERCENT,
    ),
    "status": Word("status", "`completed`, or `diverged` where any run of the interaction did"),
    "width_ever_above_yield_rad_s": Word(
        "width ever above yield", "as the width above yield, of any revolution in the last half of the run", _SPEED
    ),
    "possible_from_rad_s": Word("possibly above yield from", f"speed from which {_POSSIBLE}", _SPEED),
    "possible_to_rad_s": Word("possibly above yield to", f"speed up to which {_POSSIBLE}", _SPEED),
    "certain_from_rad_s": Word("certainly above yield from", f"speed from which {_CERTAIN}", _SPEED),
    "certain_to_rad_s": Word("certainly above yield to", f"speed up to which {_CERTAIN}", _SPEED),
    "certain_length_rad_s": Word("certainly above yield", f"length of all speeds of the row at which {_CERTAIN}", _SPEED),
    "median_von_mises_pa": Word("median stress", f"largest median over the {_REVOLUTIONS} of their von Mises stress", *_MPA),
    "high_von_mises_pa": Word("high stress", f"the same of what 90% of the {_REVOLUTIONS} stay below", *_MPA),
    "peak_motion_m": Word(
        "rms, both directions", "rms of the leading edge at the peak speed, normal and tangential together", *_MM
    ),
    "fall_speed_rad_s": Word("falls at", "speed above the peak at which the motion falls below half of it", _SPEED),
    "note": Word("note", "why columns of the row are empty"),
    "share_of_members": Word("members", "where members are run: how many of them show the interaction", *_PERCENT),
    "robust": Word("robust", "where members are run: whether at least half of them show the interaction"),
}
"""Columns of summary.csv."""

RANKING = {
    "rank": Word(
        "rank",
        "place in the scene: by the length certainly above yield, then possibly, then fewer diverged runs, then less stress",
    ),
    "length_certain_rad_s": Word("certainly above yield", f"length of all speeds at which {_CERTAIN}", _SPEED),
    "length_possible_rad_s": Word("possibly above yield", f"length of all speeds at which {_POSSIBLE}", _SPEED),
    "largest_median_stress_pa": Word(
        "largest median stress", f"largest median over the {_REVOLUTIONS} of their von Mises stress, of all speeds", *_MPA
    ),
    "first_certain_rad_s": Word("first speed certainly above yield", f"lowest speed at which {_CERTAIN}", _SPEED),
    "first_possible_rad_s": Word("first speed possibly above yield", f"lowest speed at which {_POSSIBLE}", _SPEED),
    "widest_range_rad_s": Word(
        "widest range certainly above yield", f"width of the widest range of speeds at which {_CERTAIN}", _SPEED
    ),
    "largest_rms_m": Word(
        "largest rms, both directions", "largest rms of the leading edge over all speeds, normal and tangential together", *_MM
    ),
    "largest_rms_speed_rad_s": Word("speed of the largest rms", "speed at which the rms is largest", _SPEED),
    "drop": INTERACTIONS["drop"],
    "largest_gap_rad_s": Word(
        "largest gap",
        "largest distance between neighbouring speeds that were run: a narrower interaction between them may be missed",
        _SPEED,
    ),
    "diverged_runs": Word("diverged", "runs that diverged; they count as above yield in all revolutions"),
    "members": Word("members", "number of the members of the sample"),
}
"""Columns of ranking.csv, a line for each blade and scene."""

CHANCE = "chance_better_than_"
"""Begin of columns of ranking.csv that compare a blade with another one, whose name follows."""

ENDS = {f"_{end}": "median" if quantile == 0.5 else f"{quantile:.0%}" for end, quantile in ranges.ENDS.items()}
"""Ends of columns with the quantiles over the members of a sample, and how they are called."""


def word(name: str, words: dict[str, Word]) -> Word | None:
    """What a column is called: of `words`, the scatter or members' range of one of them, or a chance; None for any other."""
    if name.startswith(CHANCE):
        other = name.removeprefix(CHANCE)
        return Word(
            f"chance to be better than {other}", f"share of the members in which the blade is better than {other}", *_PERCENT
        )
    exact = words.get(name.replace("_scatter", ""))
    if "_scatter" in name and exact:
        meaning = f"standard deviation by chance of: {exact.meaning}"
        return replace(exact, title=f"{exact.title}, scatter", meaning=meaning)
    for end, title in ENDS.items():
        nominal = words.get(name.removesuffix(end))
        if name.endswith(end) and nominal:
            return replace(nominal, title=f"{nominal.title}, {title}", meaning=f"{title} of the members: {nominal.meaning}")
    return words.get(name)
