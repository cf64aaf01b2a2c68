"""The worst interaction of each of the seven blades: linear, of second order, for longer, and by other motions."""

from typing import Any

import pandas as pd
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.results.closing import interaction_title
from r37core.results.columns import MOST_REVOLUTIONS
from r37core.results.exceedance import SpeedRange
from r37core.results.other_motions import swept, worst_exceedance
from r37core.results.ranking import read_ranking
from r37core.results.table_file import read_table

from .pages import write_table

THICKNESS = 0.005
"""Thickness (m) of the lining of the benchmark."""

NEAR = 0.06
"""Distance of two peaks, as a share of the speed, within which they are the same interaction."""

_LONGEST = 3

LENGTH, FROM, TO = "length_most_revolutions_rad_s", "most_revolutions_from_rad_s", "most_revolutions_to_rad_s"


def worst(input: Any, output: Any, params: Any) -> None:
    """Tables of both scenes. Inputs: summaries and rankings (linear, quadratic, longer). Outputs: lining, bare, every."""
    runs = [_Run(*files) for files in zip(input.summaries, input.rankings, strict=True)]
    every = [run.summary.assign(run=name) for name, run in zip(("linear", "second order", "longer"), runs, strict=True)]
    pd.concat(every).to_csv(output.every, index=False, float_format="%.6g")
    linear, quadratic, longer = runs
    head = ["blade", "worst interaction", "at (rad/s)", "motion: linear / second order (mm)"]
    head += ["above yield: airfoil / box / twice as long (rad/s)", "worst motion: mm / above yield (rad/s)"]
    for scene, twice, file in (
        ("material_abradable", "twice_abradable", output.lining),
        ("direct", "twice_direct", output.bare),
    ):
        lined = scene != "direct"
        rows = []
        for blade in dict.fromkeys(quadratic.summary["blade"]):
            row, whole = quadratic.worst(blade, scene), quadratic.ranking.loc[blade, scene]
            lengths = (whole[LENGTH], whole[LENGTH.replace("_rad", "_box_rad")], longer.ranking.loc[blade, twice][LENGTH])
            most = max(whole["largest_rms_worst_m"], whole["largest_rms_m"])
            cells = [blade, interaction_title(row["mode"], row["engine_order"]), _place(row, lined)]
            cells += [f"{linear.height(blade, scene, row['peak_speed_rad_s'])} / {1e3 * row['peak_motion_m']:.1f}"]
            cells += [" / ".join(f"{length:.0f}" for length in lengths)]
            cells += [f"{1e3 * most:.1f} / {whole['length_most_revolutions_worst_rad_s']:.0f}"]
            rows.append([*cells, *([f"{100 * row['sufficient_thickness_m'] / THICKNESS:.0f}"] if lined else [])])
        write_table([*head, *(["lining used (%)"] if lined else [])], rows, file)


def ranges(input: Any, output: Any, params: Any) -> None:
    """Longest ranges above yield on lining by the worst motion. Inputs: motions of `draft` and of `standard`. Output: table."""
    draft, standard = (_ranges_of(read_dataset(file), "material_abradable") for file in (input.draft, input.standard))
    rows = []
    for blade, found in standard.items():
        longest = sorted(sorted(found, key=lambda one: -one.length)[:_LONGEST], key=lambda one: one.begin)
        both = [one for one in longest if any(one.begin < other.end and other.begin < one.end for other in draft[blade])]
        alone = [one for one in longest if one not in both]
        rows.append([blade, _words(both), _words(alone)])
    write_table(["blade", "at both levels (rad/s)", "at standard alone (rad/s)"], rows, output.table)


def lasting(input: Any, output: Any, params: Any) -> None:
    """Ranges above yield on lining by the worst motion with twice the revolutions. Input: motions. Output: table."""
    found = _ranges_of(read_dataset(input.motions), "twice_abradable")
    rows = [[blade, _words(ranges), f"{sum(one.length for one in ranges):.0f}"] for blade, ranges in found.items()]
    write_table(["blade", "ranges (rad/s)", "in all (rad/s)"], rows, output.table)


def _words(ranges: list[SpeedRange]) -> str:
    """Ranges of speeds (rad/s) with their lengths."""
    return ", ".join(f"{one.begin:.0f} to {one.end:.0f} ({one.length:.0f})" for one in ranges)


def _ranges_of(motions: xr.Dataset, scene: str) -> dict[str, list[SpeedRange]]:
    """Ranges above yield by the worst motion of each blade in a scene."""
    own = motions.sel(scene=scene)
    blades = [str(blade) for blade in own["blade"].values]
    return {blade: worst_exceedance(swept(own.sel(blade=blade))).ranges(MOST_REVOLUTIONS) for blade in blades}


class _Run:
    """Tables of a run."""

    def __init__(self, summary: str, ranking: str):
        self.summary = read_table(summary)
        self.ranking = read_ranking(ranking).set_index(["blade", "scene"])

    def height(self, blade: str, scene: str, speed: float) -> str:
        """Largest motion (mm) of the peaks near a speed, a dash where there is none."""
        own = self.summary[(self.summary["blade"] == blade) & (self.summary["scene"] == scene)]
        near = own[(own["peak_speed_rad_s"] - speed).abs() <= NEAR * speed]
        return f"{1e3 * near['peak_motion_m'].max():.1f}" if len(near) else "-"

    def worst(self, blade: str, scene: str) -> pd.Series:
        """The interaction with the longest length above yield, or of those without any the largest motion."""
        own = self.summary[(self.summary["blade"] == blade) & (self.summary["scene"] == scene)]
        return own.sort_values([LENGTH, "peak_motion_m"], ascending=False).iloc[0]


def _place(row: pd.Series, lined: bool) -> str:
    """Speed of the peak with lining, range above yield of a bare casing, whose speed of the largest motion is chance."""
    return f"{row['peak_speed_rad_s']:.0f}" if lined else f"{row[FROM]:.0f} to {row[TO]:.0f}"
