"""Last lines of a finished run: what was found, where to look, how long it took."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from pandas import DataFrame

from r37core.base.io import InputFileError
from r37core.base.rounding import rounded_to
from r37core.results.closing import (
    counted,
    extremes,
    interaction_title,
    lining_texts,
    remarks_on_contact,
    remarks_on_diverged,
    remarks_on_limits,
)
from r37core.results.columns import LENGTHS, NOT_RESOLVED, names
from r37core.results.limits import OF_LIMITS
from r37core.results.table_file import read_table
from r37core.time_integration.speed_arrays import OF_LINING
from r37core.time_integration.status import RunStatus

_SECOND_ORDER = "peak_share_of_height"
_LENGTH, _UNKNOWN, _ = names(LENGTHS)

_COLUMNS = (
    "worn_through_share", "note", "largest_stress_inside_pa", "largest_stress_inside_pa_low",
    "largest_stress_inside_pa_high", _LENGTH, _UNKNOWN, "length_most_revolutions_worst_rad_s", "ranges_dangerous",
    "widest_range_from_rad_s", "widest_range_rad_s", "contact", "rank_lowest", "rank_highest", "rank_over_scenes",
    "largest_gap_rad_s",
)  # fmt: skip
"""Columns of summary.csv or ranking.csv that lines are made of, and that not every run has."""

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
    lines = []
    if (summary := _table(results / "summary.csv", began)) is not None:
        # a run asked for a table alone makes nothing else
        places = {"explorer.html": " (any browser)", "summary.csv": "", "figures": "/"}
        there = (f"{results / name}{more}" for name, more in places.items() if (results / name).exists())
        diverged, said = _run_counts(results / "rms.nc")
        ranked = _ranked(results / "ranking.csv", began)
        lines += [_found(summary) + diverged, *said, *ranked, *remarks, f"look at {', '.join(there)}"]
    lines += extension_lines
    return [*lines, _took(ended - began)] if lines else []


def _table(file: Path, began: float) -> DataFrame | None:
    """A table with all _COLUMNS, NaN where it has none; None where there is none that is as new as the run."""
    if not file.exists() or file.stat().st_mtime < began:
        return None
    table = read_table(file)
    return table.reindex(columns=[*dict.fromkeys([*table, *_COLUMNS])])


def _found(table: DataFrame) -> str:
    if table.empty:
        return "found no interaction"
    known = table[table[_LENGTH].notna()]
    text = f"found {counted(len(table), 'interaction')}"
    if len(known):
        dangerous, unknown = known[_LENGTH] > 0.0, known[_UNKNOWN] > 0.0
        text += f", {dangerous.sum() or 'none'} of them dangerous (above yield inside the model's limits)"
        text += f", {(unknown & ~dangerous).sum()} unknown (these are left first)" if (unknown & ~dangerous).any() else ""
    if worn_through := np.count_nonzero(table["worn_through_share"] > 0.0):
        text += f", {worn_through} with the lining worn through to the casing"
    if unresolved := sum(NOT_RESOLVED in str(note) for note in table["note"]):
        text += f", {unresolved} not resolved, as one or two speeds show the peak"
    ended = known[known["largest_stress_over_yield"].notna()]
    return (
        text if ended.empty else f"{text}; the largest stress {_worst(ended.loc[ended['largest_stress_over_yield'].idxmax()])}"
    )


def _worst(row: Any) -> str:
    """How far the stress of an interaction goes inside the model, and where."""
    where = f"{row['blade']} in {row['scene']} at {row['largest_stress_speed_rad_s']:.6g} rad/s"
    title = interaction_title(row["mode"], row["engine_order"])
    return f"{_stress(row)}, {row['largest_stress_over_yield']:.3g} times yield before the model is left, {where} ({title})"


def _stress(row: Any) -> str:
    """The largest stress; where members give it a range, with as many digits as that bears, and the range beside it."""
    nominal, low, high = (1e-9 * row[f"largest_stress_inside_pa{end}"] for end in ("", "_low", "_high"))
    if np.isnan(high - low):
        return f"{nominal:.2f} GPa"
    nominal, low_text, high_text = (rounded_to(value, high - low) for value in (nominal, low, high))
    return f"{nominal} GPa ({low_text} to {high_text} in nine tenths of the members)"


def _ranked(file: Path, began: float) -> Iterator[str]:
    """Lines on the ranking: each scene, all scenes, contact, missed speeds; nothing where stress is in no scene."""
    table = _table(file, began)
    if table is None or (table := table[table[_LENGTH].notna()]).empty:
        return
    groups = table.groupby("contact", sort=False, dropna=False)
    alike = {"" if pd.isna(contact) else contact: rows for contact, rows in groups}
    for contact, rows in alike.items():
        among = f"{contact}: " if contact else ""
        yield from (f"{among}{line}" for line in (*_extremes(rows, file), *_over_scenes(rows)))
    if any("points" in contact for contact in alike):
        yield "the ranking is of contact on points; a decision needs structure: { boundary: { contact: patches } }"
    if (gap := table["largest_gap_rad_s"].max()) > 0.0:
        yield f"speeds lie up to {gap:g} rad/s apart: a narrower interaction between them may be missed"


def _extremes(rows: DataFrame, file: Path) -> Iterator[str]:
    """Blades of each scene that may be the best and the worst, by `extremes`."""
    # of many scenes, as of a family, their tables say it
    for scene, table in rows.groupby("scene", sort=False) if rows["scene"].nunique() <= MOST_SCENES else ():
        safest, longest = (
            f"{_named(some, 'or')} {'is' if len(some) == 1 else 'may be'} {{}} ({_lengths(some)})" for some in extremes(table)
        )
        if table["rank_lowest"].max() > 1:
            yield f"{scene}: {safest.format('dangerous at the fewest speeds')}, {longest.format('at the most')}; {file}"
        elif len(table) > 1:
            yield f"{scene}: {_named(table)} cannot be ranked (dangerous over {_lengths(table)}); {file}"


def _lengths(rows: DataFrame) -> str:
    """Length of the dangerous speeds of blades that share a rank, or the range of their brackets.

    Of one its widest range where it has several, and the sustained length by other motions where it is longer.
    """
    low, high = rows[_LENGTH].min(), (rows[_LENGTH] + rows[_UNKNOWN]).max()
    if high > low:
        return f"{low:.0f} to {high:.0f} rad/s"
    row = rows.iloc[-1]
    text, ranges, worst = f"{high:.0f} rad/s", row["ranges_dangerous"], row["length_most_revolutions_worst_rad_s"]
    if ranges >= 2:
        begin, width = row["widest_range_from_rad_s"], row["widest_range_rad_s"]
        text += f" in {ranges:.0f} ranges, the widest from {begin:.0f} to {begin + width:.0f}"
    return f"{text} from rest, {worst:.0f} sustained by the worst motion" if worst > high else text


def _named(rows: DataFrame, word: str = "and") -> str:
    """Names of blades, of many the first ones; the `word` stands before the last."""
    *names, last = rows["blade"]
    if len(names) >= MOST_NAMED:
        return f"{', '.join(names[:MOST_NAMED])} {word} {len(names) + 1 - MOST_NAMED} more"
    return f"{', '.join(names)} {word} {last}" if names else last


def _over_scenes(rows: DataFrame) -> list[str]:
    """Blades ranked over all scenes, each with its longest length; nothing for one scene, and for one blade."""
    known = rows[rows["rank_over_scenes"].notna()]
    known = known.assign(end=known[_LENGTH] + known[_UNKNOWN])
    longest = known.sort_values("end", ascending=False, kind="stable").drop_duplicates("blade")
    if len(longest) < 2:
        return []
    shown = longest.sort_values(["rank_over_scenes", _LENGTH], kind="stable").head(MOST_BLADES)
    ends = shown["end"].map(" to {:.0f}".format).where(shown[_UNKNOWN] > 0.0, "")
    named = (shown["blade"] + shown[_LENGTH].map(" {:.0f}".format) + ends).groupby(shown["rank_over_scenes"], sort=False)
    places = [" = ".join(equal) for _, equal in named]
    more = ", ..." if len(longest) > MOST_BLADES else ""
    equal = " (=: cannot be told apart)" if len(places) < len(shown) else ""
    over = "both" if (scenes := rows["scene"].nunique()) == 2 else f"all {scenes}"
    return [f"over {over} scenes, by the longest length in any (rad/s): {', '.join(places)}{more}{equal}"]


def _run_counts(file: Path) -> tuple[str, list[str]]:
    """How many runs diverged, and lines on blades and scenes that never touch, and on linings; nothing where there are none."""
    # not at every start of Snakemake
    from r37core.base.dataset_file import open_dataset

    names = ("status", "largest_normal_force", *OF_LIMITS, *OF_LINING)
    try:
        with open_dataset(file) as dataset:
            rms = dataset[[name for name in names if name in dataset]].load()
    except InputFileError:
        # not there, or no dataset, which who reads it is told
        return "", []
    rms = rms.stack(run=("blade", "scene")).transpose("run", ...)
    status, pairs = rms["status"].values, rms["run"].values.tolist()
    failed, runs = status == RunStatus.DIVERGED, (status != RunStatus.NOT_RUN).sum()
    untouched = zip([" in ".join(pair) for pair in pairs], rms["largest_normal_force"].values, strict=True)
    limited = {name: rms[name].values for name in OF_LIMITS if name in rms}
    linear = np.isnan(limited.get(_SECOND_ORDER, np.full(status.shape, np.nan))).all(axis=1)
    fed = [" in ".join(pairs[number]) for number in np.flatnonzero(failed.any(axis=1) & linear)]
    few = "lined_tip_share" in rms and rms["scene"].to_index().nunique() <= MOST_SCENES
    lined = np.flatnonzero(rms["lined_tip_share"].notnull()) if few else ()
    linings = {pairs[number]: {name: rms[name].values[number] for name in OF_LINING} for number in lined}
    lines = [*remarks_on_contact([*untouched]), *remarks_on_diverged(fed), *remarks_on_limits(limited), *lining_texts(linings)]
    return f"; {failed.sum()} of {runs} runs diverged" if failed.any() else "", lines


def _took(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return "took " + (f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s" if minutes else f"{rest} s")
