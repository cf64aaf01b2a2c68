"""Last lines of a finished run: what was found, where to look, how long it took."""

import csv
from collections.abc import Iterable
from itertools import groupby, product
from pathlib import Path

import numpy as np

from r37core.base.rounding import rounded_to
from r37core.results.closing import (
    counted,
    interaction_title,
    lining_texts,
    remarks_on_contact,
    remarks_on_diverged,
    remarks_on_limits,
)
from r37core.results.columns import MOST, NOT_RESOLVED, SOME, above_yield
from r37core.results.limits import OF_LIMITS
from r37core.rom.reduction_choice import QUADRATIC
from r37core.time_integration.lining_at_tip import LINING_AT_TIP
from r37core.time_integration.status import RunStatus

_SECOND_ORDER = "peak_share_of_height"

MOST_SCENES = MOST_BLADES = 12
"""Scenes of which each has a line of its own, and blades that the line on all scenes names."""

MOST_NAMED = 4
"""Blades that the line on one scene names."""


def closing_lines(
    results: Path, began: float, ended: float, remarks: Iterable[str] = (), extension_lines: Iterable[str] = ()
) -> list[str]:
    """Last lines of a run: interactions of the folder `results`, diverged runs, `remarks` on them, where to look, time taken.

    Of what is older than the run's start nothing is said. `began` and `ended`: times in s, as file times are.
    `extension_lines`: what the extensions have made in the run.
    """
    lines = [*_sweep_lines(results, began, remarks), *extension_lines]
    return [*lines, _took(ended - began)] if lines else []


def _sweep_lines(results: Path, began: float, remarks: Iterable[str]) -> list[str]:
    summary = results / "summary.csv"
    if not summary.exists() or summary.stat().st_mtime < began:
        return []
    with open(summary, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    # a run asked for a table alone makes nothing else
    places = {"explorer.html": " (any browser)", "summary.csv": "", "figures": "/"}
    there = (f"{results / name}{more}" for name, more in places.items() if (results / name).exists())
    where = f"look at {', '.join(there)}"
    ranked = _ranked(results / "ranking.csv", began)
    diverged, said = _run_counts(results / "rms.nc")
    return [_found(rows) + diverged, *said, *ranked, *remarks, where]


def _found(rows: list[dict[str, str]]) -> str:
    if not rows:
        return "found no interaction"
    worn_through = sum(_number(row, "worn_through_share") > 0.0 for row in rows)
    known = [row for row in rows if row.get("share_of_revolutions_above_yield")]
    kinds = [above_yield(_number(row, "share_of_revolutions_above_yield")) for row in known]
    text = f"found {counted(len(rows), 'interaction')}"
    if MOST in kinds or SOME in kinds:
        text += f", {kinds.count(MOST)} of them above yield in most revolutions, {kinds.count(SOME)} in some"
    elif known:
        text += ", none of them above yield in any later revolution"
    if worn_through:
        text += f", {worn_through} with the lining worn through to the casing"
    if unresolved := sum(NOT_RESOLVED in row.get("note", "") for row in rows):
        text += f", {unresolved} not resolved, as one or two speeds show the peak"
    if ended := [row for row in known if row["largest_stress_pa"]]:
        text += f"; the largest stress {_worst(max(ended, key=lambda row: _number(row, 'largest_stress_over_yield')))}"
    return text


def _worst(row: dict[str, str]) -> str:
    """How far the stress of an interaction goes, where, and in how many of the revolutions it is above yield."""
    share, ratio = (_number(row, name) for name in ("share_of_revolutions_above_yield", "largest_stress_over_yield"))
    title = interaction_title(row["mode"], row["engine_order"])
    where = f"{row['blade']} in {row['scene']} at {_number(row, 'largest_stress_speed_rad_s'):.6g} rad/s ({title})"
    text = f"{_stress(row)}, {ratio:.3g} times yield, {where}"
    return f"{text}, above yield in up to {max(round(100.0 * share), 1)}% of the revolutions" if share > 0.0 else text


def _number(row: dict[str, str], column: str) -> float:
    """0 for a cell that is empty or not there."""
    return float(row.get(column) or 0.0)


def _stress(row: dict[str, str]) -> str:
    """The largest stress; where members give it a range, with as many digits as that bears, and the range beside it."""
    stress = 1e-9 * _number(row, "largest_stress_pa")
    ends = [row.get(f"largest_stress_pa_{end}") for end in ("low", "high")]
    if not all(ends):
        return f"{stress:.2f} GPa"
    low, high = (1e-9 * float(end or 0.0) for end in ends)
    nominal, low_text, high_text = (rounded_to(value, high - low) for value in (stress, low, high))
    return f"{nominal} GPa ({low_text} to {high_text} in nine tenths of the members)"


def _ranked(file: Path, began: float) -> list[str]:
    """Lines on the ranking: each scene, all scenes, contact, missed speeds; nothing where stress is in no scene."""
    if not file.exists() or file.stat().st_mtime < began:
        return []
    with open(file, newline="", encoding="utf-8") as stream:
        rows = [row for row in csv.DictReader(stream) if row["length_most_revolutions_rad_s"]]
    alike: dict[str, list[dict[str, str]]] = {}
    for row in rows:
        alike.setdefault(row.get("contact", ""), []).append(row)
    lines = []
    for contact, ranked in alike.items():
        among = f"{contact}: " if contact else ""
        lines += [f"{among}{line}" for line in (*_extremes(ranked, file), *_overall(ranked))]
    lines += _remarks_on_contact({contact: list(dict.fromkeys(row["blade"] for row in alike[contact])) for contact in alike})
    gap = max((_number(row, "largest_gap_rad_s") for row in rows), default=0.0)
    if gap > 0.0:
        lines.append(f"speeds lie up to {gap:g} rad/s apart: a narrower interaction between them may be missed")
    return lines


def _extremes(rows: list[dict[str, str]], file: Path) -> list[str]:
    """Best and worst blades of each scene, with all that cannot be told apart from them."""
    lines = []
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    # of many scenes, as of a family, their tables say it
    for scene in scenes if len(scenes) <= MOST_SCENES else ():
        scene_rows = [row for row in rows if row["scene"] == scene]
        best, worst = scene_rows[0], scene_rows[-1]
        if best["rank"] == worst["rank"]:
            lines += [f"{scene}: {_tied(scene_rows)}; {file}"] if len(scene_rows) > 1 else []
            continue
        safest, longest = ([row for row in scene_rows if row["rank"] == end["rank"]] for end in (best, worst))
        verb = "is" if len(safest) == 1 else "are"
        lines.append(
            f"{scene}: {_named(safest)} {verb} above yield in most revolutions at the fewest speeds ({_lengths(safest)}), "
            f"{_named(longest)} at the most ({_lengths(longest)}); {file}"
        )
    return lines


def _tied(rows: list[dict[str, str]]) -> str:
    """Text on blades that cannot be ranked, with the range of their lengths."""
    return f"{_named(rows)} cannot be ranked (above yield in most revolutions over {_lengths(rows)})"


def _lengths(rows: list[dict[str, str]]) -> str:
    """Length above yield of blades that share a rank, or the range of their lengths."""
    low, high = (end(_number(row, "length_most_revolutions_rad_s") for row in rows) for end in (min, max))
    return f"{low:.0f} to {high:.0f} rad/s" if high > low else _length(rows[-1])


def _named(rows: list[dict[str, str]]) -> str:
    """Names of blades, of many the first ones."""
    names = [row["blade"] for row in rows]
    if (more := len(names) - MOST_NAMED) > 0:
        return f"{', '.join(names[:MOST_NAMED])} and {more} more"
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _length(row: dict[str, str]) -> str:
    """Length above yield, the widest of its ranges where it has several, and the length by other motions where it is longer."""
    length, worst = (_number(row, f"length_most_revolutions_{motion}rad_s") for motion in ("", "worst_"))
    text, ranges = f"{length:.0f} rad/s", _number(row, "ranges_most_revolutions")
    if ranges >= 2:
        begin, width = _number(row, "widest_range_from_rad_s"), _number(row, "widest_range_rad_s")
        text += f" in {ranges:.0f} ranges, the widest from {begin:.0f} to {begin + width:.0f}"
    return f"{text} from rest, {worst:.0f} by the worst motion" if worst > length else text


def _overall(rows: list[dict[str, str]]) -> list[str]:
    """Blades ranked over all scenes, each with its longest length; nothing for one scene, and for one blade."""
    longest: dict[str, dict[str, str]] = {}
    for row in sorted(rows, key=lambda row: _number(row, "length_most_revolutions_rad_s")):
        if row.get("rank_over_scenes"):
            longest[row["blade"]] = row
    if len(longest) < 2:
        return []
    ranked = sorted(
        longest.values(), key=lambda row: (_number(row, "rank_over_scenes"), _number(row, "length_most_revolutions_rad_s"))
    )
    places = [
        " = ".join(f"{row['blade']} {_number(row, 'length_most_revolutions_rad_s'):.0f}" for row in equal)
        for _, equal in groupby(ranked[:MOST_BLADES], key=lambda row: row["rank_over_scenes"])
    ]
    more = ", ..." if len(ranked) > MOST_BLADES else ""
    equal = " (=: cannot be told apart)" if len(places) < len(ranked[:MOST_BLADES]) else ""
    scenes = len({row["scene"] for row in rows})
    over = "both" if scenes == 2 else f"all {scenes}"
    return [f"over {over} scenes, by the longest length in any (rad/s): {', '.join(places)}{more}{equal}"]


def _remarks_on_contact(blades: dict[str, list[str]]) -> list[str]:
    """Line on a ranking of unlike contact, or on points. `blades`: contact -> the blades that have it."""
    contact = "boundary: { contact: patches }"
    key = f"structure: {{ {contact} }}"
    if len(blades) > 1:
        if any(kind.endswith(QUADRATIC) for kind in blades):
            key = f"structure: {{ kinematics: {QUADRATIC}, {contact} }}"
        kinds = "; ".join(f"{contact}: {', '.join(names[:3])}{', ...' * (len(names) > 3)}" for contact, names in blades.items())
        return [f"ranks are among blades of the same contact ({kinds}); {key} gives one order"]
    return [f"the ranking is of contact on points; a decision needs {key}" for contact in blades if "points" in contact]


def _run_counts(file: Path) -> tuple[str, list[str]]:
    """How many runs diverged, and lines on blades and scenes that never touch, and on linings; nothing where there are none."""
    # not at every start of Snakemake
    import netCDF4

    try:
        with netCDF4.Dataset(file) as rms:
            status, names = rms["status"][:], [rms[name][:] for name in ("blade", "scene")]
            forces = np.ma.filled(rms["largest_normal_force"][:], np.nan)
            limited = {name: np.ma.filled(rms[name][:], np.nan) for name in OF_LIMITS if name in rms.variables}
            tip_numbers = {name: np.ma.filled(rms[name][:], np.nan).ravel() for name in LINING_AT_TIP if name in rms.variables}
    except OSError:
        # not there, or no dataset, which who reads it is told
        return "", []
    failed, runs = status == RunStatus.DIVERGED, (status != RunStatus.NOT_RUN).sum()
    reached = limited.get(_SECOND_ORDER, np.full(status.shape, np.nan))
    diverged, linear = failed.sum(), ~np.isfinite(reached).any(axis=-1)
    pairs = list(product(*names))
    touching = zip(pairs, forces.reshape(-1, forces.shape[-1]), strict=True)
    untouched = remarks_on_contact([(f"{blade} in {scene}", force) for (blade, scene), force in touching])
    lined = [pair for pair, share in enumerate(tip_numbers.get("lined_tip_share", ())) if np.isfinite(share)]
    if len(names[1]) > MOST_SCENES:
        lined = []
    linings = lining_texts({pairs[pair]: {name: values[pair] for name, values in tip_numbers.items()} for pair in lined})
    fed = [" in ".join(pairs[number]) for number in np.flatnonzero(failed.any(axis=-1) & linear)]
    far = remarks_on_diverged(fed) + remarks_on_limits(limited)
    return f"; {diverged} of {runs} runs diverged" if diverged else "", [*untouched, *far, *linings]


def _took(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return "took " + (f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s" if minutes else f"{rest} s")
