"""What the columns of the tables are called and mean: the one source of docs/results.md and of the explorer's column heads."""

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
_REVOLUTIONS = "later revolutions"
"""Revolutions in the second half of a run; the last hundred of one that goes on until it settles."""

_POSSIBLE = f"more than {POSSIBLE:.0%} of the {_REVOLUTIONS} exceed yield"
_CERTAIN = f"more than {CERTAIN:.0%} of the {_REVOLUTIONS} exceed yield"
_MEDIAN = f"median of the von Mises stress over the {_REVOLUTIONS}"
_MOST, _SOME = "above yield in most revolutions", "above yield in some revolutions"

INTERACTIONS = {
    "blade": Word("blade", "name of the blade"),
    "scene": Word("scene", "name of the scene"),
    "mode": Word("mode", "mode of the crossing that explains the peak: 1B, 1T, 2B or empty"),
    "engine_order": Word("engine order", "engine order of that crossing, or else the strongest order of the spectrum"),
    "direction": Word("direction", "direction of the peak: normal to the casing, tangential or both"),
    "campbell_speed_rad_s": Word("Campbell speed", "speed of that crossing in the Campbell diagram", _SPEED),
    "peak_speed_rad_s": Word("peak speed", "speed at which the leading edge moves most", _SPEED),
    "shift_rad_s": Word("shift", "peak speed minus Campbell speed", _SPEED),
    "peak_rms_normal_m": Word("normal rms", "rms normal to the casing at the peak speed", *_MM),
    "peak_rms_tangential_m": Word("tangential rms", "tangential rms at the peak speed", *_MM),
    "drop": Word(
        "amplitude lost above the peak", f"share of the amplitude lost within {DROP_WITHIN:g} rad/s above the peak", *_PERCENT
    ),
    "first_yield_speed_rad_s": Word("first speed above yield", "lowest speed with stress above yield", _SPEED),
    "width_above_yield_rad_s": Word(
        "width above yield", "distance from the first to the last speed above yield, ends interpolated", _SPEED
    ),
    "share_above_yield": Word(
        "part of the width above yield", "share of this width that is above yield: chaotic motion leaves gaps", *_PERCENT
    ),
    "max_von_mises_pa": Word("largest stress, last revolution", "largest von Mises stress of the last revolution", *_MPA),
    "max_von_mises_speed_rad_s": Word("at speed", "speed of the largest stress", _SPEED),
    "stress_region": Word("stress region", "part of the blade where stress is evaluated"),
    "max_wear_m": Word("largest wear", "largest wear of the lining", *_MM),
    "worn_through_share": Word(
        "worn through",
        "largest share of the circumference where the tip has reached the casing behind the lining",
        *_PERCENT,
    ),
    "sufficient_thickness_m": Word(
        "sufficient thickness",
        "lining thickness that the interaction uses, elastic part included, where it wears; a lower bound where a run is worn "
        "through or diverged",
        *_MM,
    ),
    "motion_at_end": Word(
        "motion at the end",
        "at the peak speed: `growing`, `lasting`, `cut_free` (has decayed or lost contact) or `quiet` (within the clearance)",
    ),
    "lasting_share": Word("lasting", "share of the interaction's speeds whose motion lasts or grows at the end", *_PERCENT),
    "largest_penetration_m": Word(
        "largest penetration",
        "largest penetration of the tip's edge into the casing (behind a lining)",
        *_MM,
    ),
    "status": Word("status", "`completed`, or `diverged` if any run of the interaction did"),
    "width_ever_above_yield_rad_s": Word(
        "width ever above yield", f"width above yield if any of the {_REVOLUTIONS} counts", _SPEED
    ),
    "possible_from_rad_s": Word(f"{_SOME} from", f"lowest speed at which {_POSSIBLE}", _SPEED),
    "possible_to_rad_s": Word(f"{_SOME} to", "highest such speed", _SPEED),
    "certain_from_rad_s": Word(f"{_MOST} from", f"lowest speed at which {_CERTAIN}", _SPEED),
    "certain_to_rad_s": Word(f"{_MOST} to", "highest such speed", _SPEED),
    "certain_length_rad_s": Word(_MOST, f"length of all speeds at which {_CERTAIN}", _SPEED),
    "median_von_mises_pa": Word("median stress", f"largest {_MEDIAN}", *_MPA),
    "high_von_mises_pa": Word("high stress", f"largest 90% quantile of the von Mises stress over the {_REVOLUTIONS}", *_MPA),
    "largest_goodman_share": Word("Goodman share", "largest share of the Goodman line"),
    "peak_motion_m": Word("rms, both directions", "normal and tangential rms together, at the peak speed", *_MM),
    "fall_speed_rad_s": Word("falls at", "speed above the peak at which the motion falls below half of it", _SPEED),
    "note": Word("note", "reason for empty columns, and where the lining is worn through"),
    "second_motion": Word("second motion", "motion, carried `up` or `down`, that is most above that from rest"),
    "second_motion_speed_rad_s": Word("speed of the second motion", "its speed", _SPEED),
    "second_motion_rms_normal_m": Word("normal rms of the second motion", "its normal rms", *_MM),
    "second_motion_rest_rms_normal_m": Word("normal rms from rest there", "normal rms from rest at that speed", *_MM),
    "share_of_members": Word("members", "share of the members that show the interaction", *_PERCENT),
    "robust": Word("robust", "whether at least half of the members show it"),
}
"""Columns of summary.csv."""

RANKING = {
    "rank": Word("rank", "place in the scene: by length above yield in most, then in some revolutions, diverged runs, stress"),
    "length_certain_rad_s": Word(_MOST, f"length of all speeds at which {_CERTAIN}", _SPEED),
    "length_possible_rad_s": Word(_SOME, f"length of all speeds at which {_POSSIBLE}", _SPEED),
    "length_ever_rad_s": Word(
        "ever above yield", f"length of all speeds at which any of the {_REVOLUTIONS} exceeds yield", _SPEED
    ),
    "length_lasting_rad_s": Word(f"{_MOST}, lasting", "the same where the motion lasts or grows at the end", _SPEED),
    "exceedance_integral_rad_s": Word(
        "integral above yield", f"integral over speed of the share of {_REVOLUTIONS} that exceed yield", _SPEED
    ),
    "largest_goodman_share": INTERACTIONS["largest_goodman_share"],
    "length_goodman_rad_s": Word(
        "above the Goodman line in most revolutions",
        "length of all speeds above the Goodman line in most revolutions",
        _SPEED,
    ),
    "goodman_integral_rad_s": Word(
        "integral above the Goodman line",
        "integral over speed of the share of revolutions above the Goodman line",
        _SPEED,
    ),
    "largest_median_stress_pa": Word("largest median stress", f"largest {_MEDIAN}", *_MPA),
    "first_certain_rad_s": Word(f"first speed {_MOST}", f"lowest speed at which {_CERTAIN}", _SPEED),
    "first_possible_rad_s": Word(f"first speed {_SOME}", f"lowest speed at which {_POSSIBLE}", _SPEED),
    "widest_range_rad_s": Word(f"widest range {_MOST}", "width of the widest of these ranges", _SPEED),
    "largest_rms_m": Word(
        "largest rms, both directions", "largest normal and tangential rms of the leading edge together", *_MM
    ),
    "largest_rms_speed_rad_s": Word("speed of the largest rms", "its speed", _SPEED),
    "drop": INTERACTIONS["drop"],
    "largest_gap_rad_s": Word(
        "largest gap", "largest distance of neighbouring speeds: it can hide a narrower interaction", _SPEED
    ),
    "diverged_runs": Word("diverged", "diverged runs"),
    "length_certain_rest_rad_s": Word(f"{_MOST}, from rest", "this length from rest, at the speeds of sweeps", _SPEED),
    "length_certain_worst_rad_s": Word(
        f"{_MOST}, worst motion", "this length by the worst motion up, down and from rest", _SPEED
    ),
    "largest_rms_worst_m": Word("largest rms, worst motion", "largest rms of these motions", *_MM),
    "rank_worst": Word("rank by the worst motion", "place by the worst motion"),
    "members": Word("members", "members of the sample"),
    "length_certain_operating_rad_s": Word(f"{_MOST}, in operation", "this length inside the operating range", _SPEED),
    "exceedance_integral_operating_rad_s": Word(
        "integral above yield, in operation", "the integral over the operating range, weighted by its dwells", _SPEED
    ),
    "goodman_integral_operating_rad_s": Word(
        "integral above Goodman, in operation", "the same of the share of revolutions above the Goodman line", _SPEED
    ),
    "rank_operating": Word("rank in operation", "place by this integral"),
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
