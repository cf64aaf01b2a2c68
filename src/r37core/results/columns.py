"""Columns of summary.csv and ranking.csv, each declared once: the tables and columns.csv of the pages follow.

Extensions declare those that they add (plans.extension.AddedColumns). Light: the configuration imports it.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import isnan

from r37core.base.units import shown_unit, si_name, unit_of

MOST_REVOLUTIONS, SOME_REVOLUTIONS = 0.5, 0.05
"""Shares of the revolutions above which a speed counts as above yield in most, and in some, revolutions."""

MOST, SOME, NEVER = "most", "some", "never"
"""Words for a stress above yield in most of the judged revolutions, in some of them, or in none."""

NOT_RESOLVED = "not resolved"
"""Begin of the note on a length that counts a peak of which one or two speeds are above half of its height."""

DROP_WITHIN = 24.0
"""Speeds (rad/s) above a peak over which its motion counts as dropped."""

ENDS = {"low": 0.05, "median": 0.5, "high": 0.95}
"""End of a column's name -> quantile of the members: nine tenths of them lie between the outer two."""

CHANCE = "chance_better_than_"
"""Begin of columns of ranking.csv that compare a blade with another one, whose name follows."""


IN_REGION = "length_most_revolutions_{}_rad_s"
"""Columns of ranking.csv with the length in a region of the stress that does not decide, by its name."""


@dataclass(frozen=True)
class Column:
    """Column of a table: its `name`, which ends with its SI unit, and its `meaning`; `words`: title that is not the name.

    `percent`: whether a share is shown in percent; `scatter`: whether its standard deviation by chance follows it.
    """

    name: str
    meaning: str
    words: str = ""
    percent: bool = False
    scatter: bool = False

    @property
    def title(self) -> str:
        """Short name in words."""
        return self.words or self.measure.replace("_", " ")

    @property
    def unit(self) -> str:
        """Unit in which values are shown, empty for a plain number."""
        return "%" if self.percent else shown_unit(unit_of(self.name))[0]

    @property
    def factor(self) -> float:
        """Factor from the SI unit to the shown one."""
        return 100.0 if self.percent else shown_unit(unit_of(self.name))[1]

    @property
    def measure(self) -> str:
        """Name without its unit: the variable of datasets that hold the same number."""
        return si_name(self.name)[0]

    @property
    def scatter_name(self) -> str:
        """Name of the column with the standard deviation by chance."""
        return f"{self.measure}_scatter{self.name.removeprefix(self.measure)}"

    @property
    def range_names(self) -> list[str]:
        """Names of the columns with the range over the members."""
        return [f"{self.name}_{end}" for end in ENDS]


def above_yield(share: float) -> str:
    """MOST, SOME or NEVER, by a share of the revolutions above yield; empty where it is not known."""
    return "" if isnan(share) else MOST if share > MOST_REVOLUTIONS else SOME if share > 0.0 else NEVER


def names(columns: Iterable[Column]) -> list[str]:
    """Names of the columns in a table, each followed by that of its scatter."""
    return [name for column in columns for name in (column.name, *([column.scatter_name] if column.scatter else []))]


_REVOLUTIONS = "later revolutions"
"""Revolutions in the second half of a run; the last hundred of one that goes on until it settles."""

_IN_SOME = f"more than {SOME_REVOLUTIONS:.0%} of the {_REVOLUTIONS} exceed yield"
_IN_MOST = f"more than {MOST_REVOLUTIONS:.0%} of the {_REVOLUTIONS} exceed yield"
_STRESS = f"of the von Mises stress over the {_REVOLUTIONS}"
_MOST, _SOME = "above yield in most revolutions", "above yield in some revolutions"
_LOST = f"share of the amplitude lost within {DROP_WITHIN:g} rad/s above the peak"

LENGTHS = (
    Column("length_most_revolutions_rad_s", f"length of all speeds at which {_IN_MOST}", _MOST),
    Column("length_some_revolutions_rad_s", f"length of all speeds at which {_IN_SOME}", _SOME),
    Column("length_ever_rad_s", f"length of all speeds at which any of the {_REVOLUTIONS} exceeds yield", "ever above yield"),
)
"""How long a range of speeds is above yield (results.exceedance)."""

DANGER = (
    *LENGTHS,
    Column(
        "share_of_revolutions_above_yield",
        f"largest share, at any of the speeds, of the {_REVOLUTIONS} that exceed yield",
        "revolutions above yield",
        percent=True,
    ),
    Column("largest_median_stress_pa", f"largest median {_STRESS}", "median stress"),
    Column("largest_high_stress_pa", f"largest 90% quantile {_STRESS}", "high stress"),
    Column("largest_stress_pa", f"largest {_STRESS}", "largest stress"),
    Column("largest_stress_over_yield", "largest stress over the yield stress", "times yield"),
    Column("largest_stress_speed_rad_s", "speed of the largest stress", "at speed"),
    Column("largest_goodman_share", "largest share of the Goodman line", "Goodman share"),
)
"""How dangerous a range of speeds is, the same for interactions, blades, designs and members (results.danger)."""

INTERACTIONS = (
    Column("blade", "name of the blade"),
    Column("scene", "name of the scene"),
    Column("mode", "mode of the crossing that explains the peak, 1B, or combination of two, 7-5 or 5+7; empty without one"),
    Column("engine_order", "engine order that the mode, difference or sum crosses, or else the strongest one"),
    Column("direction", "direction of the peak: normal to the casing, tangential or both"),
    Column("campbell_speed_rad_s", "speed of that crossing in the Campbell diagram", "Campbell speed"),
    Column("peak_speed_rad_s", "speed at which the leading edge moves most"),
    Column("shift_rad_s", "peak speed minus Campbell speed"),
    Column("peak_rms_normal_m", "rms normal to the casing at the peak speed", "normal rms"),
    Column("peak_rms_tangential_m", "tangential rms at the peak speed", "tangential rms"),
    Column("drop", _LOST, "amplitude lost above the peak", percent=True),
    *DANGER,
    Column("max_von_mises_span", "span of the largest stress", "span"),
    Column("max_von_mises_chord", "chord of the largest stress", "chord"),
    Column("max_von_mises_side", "side of the largest stress", "side"),
    Column("stress_region", "part of the blade where stress is evaluated"),
    Column("max_wear_m", "largest wear of the lining", "largest wear"),
    Column(
        "worn_through_share",
        "largest share of the circumference where the tip has reached the casing behind the lining",
        "worn through",
        percent=True,
    ),
    Column(
        "sufficient_thickness_m",
        "lining thickness that the interaction uses, elastic part included, where it wears; a lower bound where a run is worn "
        "through or diverged",
    ),
    Column("largest_penetration_m", "largest penetration of the tip's edge into the casing (behind a lining)"),
    Column("status", "`completed`, or `diverged` if any run of the interaction did"),
    Column(
        "motion_at_end",
        "at the peak speed: `growing`, `lasting`, `cut_free` (has decayed or lost contact) or `quiet` (within the clearance)",
        "motion at the end",
    ),
    Column(
        "lasting_share", "share of the interaction's speeds whose motion lasts or grows at the end", "lasting", percent=True
    ),
    Column("some_revolutions_from_rad_s", f"lowest speed at which {_IN_SOME}", f"{_SOME} from", scatter=True),
    Column("some_revolutions_to_rad_s", f"highest speed at which {_IN_SOME}", f"{_SOME} to", scatter=True),
    Column("most_revolutions_from_rad_s", f"lowest speed at which {_IN_MOST}", f"{_MOST} from", scatter=True),
    Column("most_revolutions_to_rad_s", f"highest speed at which {_IN_MOST}", f"{_MOST} to", scatter=True),
    Column("peak_motion_m", "normal and tangential rms together, at the peak speed", "rms, both directions", scatter=True),
    Column("fall_speed_rad_s", "speed above the peak at which the motion falls below half of it", "falls at", scatter=True),
    Column("note", "reason for empty columns, and where the lining is worn through"),
)
"""Columns of summary.csv in their order.

What is named peak is at the peak speed, what is named max the largest within the interaction. What ends in scatter is the
standard deviation by chance of what stands before it (results.exceedance). NaN is what a scene does not compute.
"""

ROBUSTNESS = (
    *(replace(column, scatter=True) for column in LENGTHS[:2]),
    *DANGER[2:],
    Column(
        "length_most_revolutions_within_rad_s",
        "by how much that length may be off: two standard deviations by chance and speeds, and the level's error",
        "known within",
    ),
    Column("length_some_revolutions_within_rad_s", "the same of the length in some revolutions", "known within"),
    Column(
        "length_lasting_rad_s",
        "length of all speeds above yield in most revolutions whose motion lasts or grows at the end",
        f"{_MOST}, lasting",
    ),
    Column(
        "exceedance_integral_rad_s",
        f"integral over speed of the share of {_REVOLUTIONS} that exceed yield",
        "integral above yield",
        scatter=True,
    ),
    Column(
        "length_goodman_rad_s",
        "length of all speeds above the Goodman line in most revolutions",
        "above the Goodman line in most revolutions",
    ),
    Column(
        "goodman_integral_rad_s",
        "integral over speed of the share of revolutions above the Goodman line",
        "integral above the Goodman line",
    ),
    Column("first_most_revolutions_rad_s", f"lowest speed {_MOST}", f"first speed {_MOST}"),
    Column("first_some_revolutions_rad_s", f"lowest speed {_SOME}", f"first speed {_SOME}"),
    Column("widest_range_rad_s", "width of the widest range above yield in most revolutions", f"widest range {_MOST}"),
    Column("widest_range_from_rad_s", "lowest speed of the widest range above yield", "widest range from"),
    Column("ranges_most_revolutions", "number of ranges above yield in most revolutions", f"ranges {_MOST}"),
    Column("largest_rms_m", "largest normal and tangential rms of the leading edge together", "largest rms, both directions"),
    Column("largest_rms_speed_rad_s", "speed of the largest rms", "speed of the largest rms"),
    Column("drop", _LOST, "amplitude lost above the peak", percent=True),
    Column("largest_gap_rad_s", "largest distance of neighbouring speeds: it can hide a narrower interaction"),
    Column("diverged_runs", "diverged runs", "diverged"),
)
"""Measures of a response, the same for blades, designs and members."""

OPERATING = (
    Column("length_most_revolutions_operating_rad_s", "this length inside the operating range", f"{_MOST}, in operation"),
    Column(
        "length_most_revolutions_operating_within_rad_s", "by how much that length may be off", "in operation, known within"
    ),
    Column(
        "exceedance_integral_operating_rad_s",
        "integral over the operating range of the share of later revolutions above yield, weighted by its dwells",
        "integral above yield, in operation",
        scatter=True,
    ),
    Column(
        "goodman_integral_operating_rad_s",
        "integral over the operating range of the share of revolutions above the Goodman line, weighted by the dwells",
        "integral above Goodman, in operation",
    ),
)
"""Measures of a response inside the operating range."""

OVER_SCENES = (
    Column("rank_over_scenes", "rank by the longest length in any scene; shared by what cannot be told apart"),
    Column("worst_rank", "worst rank of the blade in any scene"),
    Column("length_over_scenes_rad_s", "sum of the lengths above yield over all scenes", f"{_MOST}, all scenes"),
)
"""Columns of ranking.csv that are the same in all scenes, where there are several."""

RANKING = (
    Column(
        "rank",
        "place in the scene, by length above yield in most, then in some revolutions; shared by what cannot be told apart",
    ),
    Column("rank_lowest", "one more than the blades that are surely better"),
    Column("rank_highest", "place where all that are not surely worse stand before it"),
    Column("contact", "contact nodes, kinematics; ranks and chances are among equals"),
    *OVER_SCENES,
    *ROBUSTNESS,
    Column("members", "members of the sample"),
    *OPERATING,
    Column("rank_operating", "place by the integral over the operating range", "rank in operation"),
)
"""Columns of ranking.csv next to blade, scene, ranges over members and chances."""


def column_named(name: str, columns: Iterable[Column]) -> Column | None:
    """The column of this name: one of `columns`, the scatter or range over members of one, a chance; None for any other."""
    if name.startswith(CHANCE):
        other = name.removeprefix(CHANCE)
        meaning = f"share of the members in which the blade is better than {other}"
        return Column(name, meaning, f"chance to be better than {other}", percent=True)
    before, after = IN_REGION.split("{}")
    for column in columns:
        if name == column.name:
            return column
        if name == column.scatter_name:
            meaning = f"standard deviation by chance of: {column.meaning}"
            return replace(column, words=f"{column.title}, scatter", meaning=meaning)
        if name in column.range_names:
            quantile = ENDS[name.removeprefix(f"{column.name}_")]
            end = "median" if quantile == 0.5 else f"{quantile:.0%}"
            return replace(column, words=f"{column.title}, {end}", meaning=f"{end} of the members: {column.meaning}")
    if name.startswith(before) and name.endswith(after):
        region = name.removeprefix(before).removesuffix(after)
        return Column(name, f"length of all speeds at which {_IN_MOST} in the region {region}", f"{_MOST}, {region}")
    return None
