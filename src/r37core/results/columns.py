"""Columns of summary.csv and ranking.csv, each declared once: the tables and columns.csv of the pages follow.

Extensions declare those that they add (plans.extension.AddedColumns). Light: the configuration imports it.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

from r37core.base.units import si_name

from .limits import Cause

MOST_REVOLUTIONS = 0.5
"""Share of the later revolutions above which a speed counts as above yield in most of them."""

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
    """Column of a table: its `name`, which ends with its SI unit, and its `meaning`.

    `scatter`: whether its standard deviation by chance follows it.
    """

    name: str
    meaning: str
    scatter: bool = False

    @property
    def scatter_name(self) -> str:
        """Name of the column with the standard deviation by chance."""
        measure, _ = si_name(self.name)
        return f"{measure}_scatter{self.name.removeprefix(measure)}"

    @property
    def range_names(self) -> list[str]:
        """Names of the columns with the range over the members."""
        return [f"{self.name}_{end}" for end in ENDS]


def names(columns: Iterable[Column]) -> list[str]:
    """Names of the columns in a table, each followed by that of its scatter."""
    return [name for column in columns for name in (column.name, *([column.scatter_name] if column.scatter else []))]


_REVOLUTIONS = "later revolutions"
"""Revolutions in the second half of a run; the last hundred of one that goes on until it settles."""

_IN_MOST = f"more than {MOST_REVOLUTIONS:.0%} of the {_REVOLUTIONS} exceed yield"
_STRESS = f"of the von Mises stress over the {_REVOLUTIONS}"
_DANGEROUS = "where yield is passed in some revolution, before the model's limits are left"
_LOST = f"share of the amplitude lost within {DROP_WITHIN:g} rad/s above the peak"

LENGTHS = (
    Column("length_dangerous_rad_s", f"length of all dangerous speeds, {_DANGEROUS}"),
    Column("length_unknown_rad_s", "length of all unknown speeds, at which the model's limits are left before yield is passed"),
    Column("length_most_revolutions_rad_s", f"length of all speeds at which {_IN_MOST}"),
)
"""How long a range of speeds is dangerous, unknown and sustained (results.danger)."""

LEFT_BY = {
    cause: Column(f"runs_left_by_{cause.text}", f"runs that leave the model's limits first by {words}")
    for cause, words in {
        Cause.HEIGHT: "their motion, next to the blade's height",
        Cause.FORCE: "their contact force",
        Cause.HEAT: "the heat of the friction",
        Cause.ENERGY: "energy that is unaccounted for or bounded",
    }.items()
}
"""Column of the runs that leave the model's limits, by the cause."""

DANGER = (
    *LENGTHS,
    Column("share_of_revolutions_above_yield", f"largest share, at any of the speeds, of the {_REVOLUTIONS} that exceed yield"),
    Column("largest_median_stress_pa", f"largest median {_STRESS}"),
    Column("largest_high_stress_pa", f"largest 90% quantile {_STRESS}"),
    Column("largest_stress_pa", "largest von Mises stress of all revolutions"),
    Column("largest_stress_inside_pa", "largest von Mises stress before the model's limits are left"),
    Column("largest_stress_over_yield", "this stress over the yield stress"),
    Column("largest_stress_speed_rad_s", "its speed"),
    Column("largest_goodman_share", "largest share of the Goodman line"),
    *LEFT_BY.values(),
)
"""How dangerous a range of speeds is, the same for interactions, blades, designs and members (results.danger)."""

INTERACTIONS = (
    Column("blade", "name of the blade"),
    Column("scene", "name of the scene"),
    Column("mode", "mode of the crossing that explains the peak, 1B, or combination of two, 7-5 or 5+7; empty without one"),
    Column("engine_order", "engine order that the mode, difference or sum crosses, or else the strongest one"),
    Column("direction", "direction of the peak: normal to the casing, tangential or both"),
    Column("campbell_speed_rad_s", "speed of that crossing in the Campbell diagram"),
    Column("peak_speed_rad_s", "speed at which the leading edge moves most"),
    Column("shift_rad_s", "peak speed minus Campbell speed"),
    Column("peak_rms_normal_m", "rms normal to the casing at the peak speed"),
    Column("peak_rms_tangential_m", "tangential rms at the peak speed"),
    Column("drop", _LOST),
    *DANGER,
    Column("max_von_mises_span", "span of the largest stress"),
    Column("max_von_mises_chord", "chord of the largest stress"),
    Column("max_von_mises_side", "side of the largest stress"),
    Column("stress_region", "part of the blade where stress is evaluated"),
    Column("max_wear_m", "largest wear of the lining"),
    Column("worn_through_share", "largest share of the circumference where the tip has reached the casing behind the lining"),
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
    ),
    Column("lasting_share", "share of the interaction's speeds whose motion lasts or grows at the end"),
    Column("from_rad_s", "lowest speed of a row in direct contact: dangerous or sustained"),
    Column("to_rad_s", "its highest speed"),
    Column("dangerous_from_rad_s", "lowest dangerous speed"),
    Column("dangerous_to_rad_s", "highest dangerous speed"),
    Column("most_revolutions_from_rad_s", f"lowest speed at which {_IN_MOST}", scatter=True),
    Column("most_revolutions_to_rad_s", f"highest speed at which {_IN_MOST}", scatter=True),
    Column("peak_motion_m", "normal and tangential rms together, at the peak speed", scatter=True),
    Column("fall_speed_rad_s", "speed above the peak at which the motion falls below half of it", scatter=True),
    Column("note", "reason for empty columns, and where the lining is worn through"),
)
"""Columns of summary.csv in their order.

What is named peak is at the peak speed, what is named max the largest within the interaction. What ends in scatter is the
standard deviation by chance of what stands before it (results.exceedance). NaN is what a scene does not compute.
"""

ROBUSTNESS = (
    *LENGTHS[:2],
    replace(LENGTHS[2], scatter=True),
    *DANGER[3:],
    Column(
        "length_dangerous_within_rad_s",
        "by how much that length may be off: two standard deviations by the distance of the speeds, and the level's error",
    ),
    Column(
        "length_lasting_rad_s", "length of all speeds above yield in most revolutions whose motion lasts or grows at the end"
    ),
    Column("exceedance_integral_rad_s", f"integral over speed of the share of {_REVOLUTIONS} that exceed yield", scatter=True),
    Column("length_goodman_rad_s", "length of all speeds above the Goodman line in most revolutions"),
    Column("goodman_integral_rad_s", "integral over speed of the share of revolutions above the Goodman line"),
    Column("first_dangerous_rad_s", "lowest dangerous speed"),
    Column("first_most_revolutions_rad_s", f"lowest speed at which {_IN_MOST}"),
    Column("widest_range_rad_s", "width of the widest range of dangerous speeds"),
    Column("widest_range_from_rad_s", "its lowest speed"),
    Column("ranges_dangerous", "number of ranges of dangerous speeds"),
    Column("largest_rms_m", "largest normal and tangential rms of the leading edge together"),
    Column("largest_rms_speed_rad_s", "speed of the largest rms"),
    Column("drop", _LOST),
    Column("largest_gap_rad_s", "largest distance of neighbouring speeds: it can hide a narrower interaction"),
    Column("diverged_runs", "diverged runs"),
)
"""Measures of a response, the same for blades, designs and members."""

OPERATING = (
    Column("length_dangerous_operating_rad_s", "length of the dangerous speeds inside the operating range"),
    Column("length_unknown_operating_rad_s", "length of the unknown speeds inside it"),
    Column("length_most_revolutions_operating_rad_s", f"length inside it at which {_IN_MOST}"),
    Column(
        "exceedance_integral_operating_rad_s",
        "integral over the operating range of the share of later revolutions above yield, weighted by its dwells",
        scatter=True,
    ),
    Column(
        "goodman_integral_operating_rad_s",
        "integral over the operating range of the share of revolutions above the Goodman line, weighted by the dwells",
    ),
)
"""Measures of a response inside the operating range."""

OVER_SCENES = (
    Column("rank_over_scenes", "rank by the longest length in any scene; shared by what cannot be told apart"),
    Column("worst_rank", "worst rank of the blade in any scene"),
    Column("length_over_scenes_rad_s", "sum of the lengths of dangerous speeds over all scenes"),
)
"""Columns of ranking.csv that are the same in all scenes, where there are several."""

RANKING = (
    Column(
        "rank",
        "place in the scene, by the bracket from dangerous speeds to these and unknown ones; shared where brackets overlap",
    ),
    Column("rank_lowest", "one more than the blades that are surely better"),
    Column("rank_highest", "place where all that are not surely worse stand before it"),
    Column("contact", "contact nodes, kinematics; ranks and chances are among equals"),
    *OVER_SCENES,
    *ROBUSTNESS,
    Column("members", "members of the sample"),
    *OPERATING,
    Column("rank_operating", "place by the integral over the operating range"),
)
"""Columns of ranking.csv next to blade, scene, ranges over members and chances."""
