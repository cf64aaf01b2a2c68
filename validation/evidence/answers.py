"""Which blade and which interactions: the one set of runs, what it was tried with, and what linear theory gives."""

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes

from r37core.base.dataset_file import read_dataset
from r37core.figures import style
from r37core.results.closing import interaction_title
from r37core.results.columns import LENGTHS, names
from r37core.results.danger import ranges_of
from r37core.results.exceedance import SpeedRange, joined, length_of
from r37core.results.measures import motion
from r37core.results.ranking import read_ranking
from r37core.results.regions import read_judged
from r37core.results.table_file import read_table

from .tables import danger_cell, write_table

LINING, BARE = "material_abradable", "direct"
SCENES = {BARE: "bare casing", LINING: "abradable lining"}
TRIED = {"twice": "twice as long", "friction": "0.1% more friction", "elastic": "flexible casing"}
"""Scenes of the cases by the beginning of their names, and what they vary."""

DRAWN_LENGTHS = dict(zip(names(LENGTHS), ("dangerous", "unknown", "sustained"), strict=True))
"""Column of the ranking, and its name in the table."""

SUSTAINED = {
    "box at the root": "length_most_revolutions_box_rad_s",
    "modes above 7.5 kHz, too": "length_most_revolutions_airfoil_unfiltered_rad_s",
}
"""Sustained lengths in another region of the stress."""

GRIDS = {LINING: "every 10 rad/s about 1B/4", BARE: "every 50 rad/s"}
"""Speeds of the runs that vary something."""

LISTED = dict(zip((LINING, BARE), names(LENGTHS)[::2], strict=True))
"""Column of the length whose ranges are listed by contact: on the bare casing most speeds are unknown."""

DRAWN = ("Ref", "S100")
"""Blades whose motion is drawn: without sweep, and with most of it."""

INTERACTIONS = (
    *("blade", "1B/4 at (rad/s)", "1B/6 at (rad/s)", "three longest ranges (rad/s)", "all ranges (rad/s)"),
    *("of these near 1B/4, 1B/6 (rad/s)", "largest motion (mm)", "largest at"),
)
"""Columns of the tables of interactions: dangerous ranges on the lining; without it sustained ones."""

MOTION = ("largest motion (mm)", "at (rad/s)", "dangerous / unknown / sustained (rad/s)")
"""Columns of the table of large motion, for each contact."""

NEAR = (0.98, 1.08)
"""What is near a crossing, as shares of its speed."""

_LONGEST = 3
_NEUTRAL = "#767676"  # letters and lines that can be read on a white and on a dark page
_ON_ANY_PAGE: dict[Any, Any] = {
    **dict.fromkeys(("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color"), _NEUTRAL),
    **dict.fromkeys(("figure.facecolor", "axes.facecolor"), "none"),
    **{f"{name}size": 10 for name in ("font.", "axes.title", "axes.label", "xtick.label", "ytick.label", "legend.font")},
    "grid.color": _NEUTRAL,
}


def draw(input: Any, output: Any, params: Any) -> None:
    """Dangerous, unknown and sustained lengths by blade and contact. Input: ranking. Outputs: table, picture."""
    ranking = read_ranking(input.ranking).set_index(["scene", "blade"])
    lengths = {words: ranking.loc[scene, list(DRAWN_LENGTHS)] for scene, words in SCENES.items()}
    cells = {f"{words}: {name}": of[column] for words, of in lengths.items() for column, name in DRAWN_LENGTHS.items()}
    _write(pd.DataFrame(cells).map("{:.0f}".format), output.table)
    with plt.rc_context(_ON_ANY_PAGE):
        figure, panels = plt.subplots(2, 1, figsize=(5.2, 5.0), sharex=True)
        for axes, (words, of) in zip(panels, lengths.items(), strict=True):
            _bars(axes, of)
            axes.set_title(words, loc="left", fontweight="bold")
        panels[-1].set_xlabel("length of the speeds (rad/s), of 1,250 rad/s")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3, handlelength=1.2)
        style.save(figure, output.picture, dots_per_inch=150)


def _bars(axes: Axes, lengths: pd.DataFrame) -> None:
    """A bar of dangerous speeds for each blade, that of unknown ones behind it, and a mark at the sustained ones."""
    dangerous, unknown, sustained = (lengths[column] for column in DRAWN_LENGTHS)
    places = np.arange(len(lengths), dtype=float)
    axes.barh(places, dangerous, 0.6, color="#D55E00", label="dangerous")
    axes.barh(places, unknown, 0.6, dangerous, label="unknown", **style.UNKNOWN | {"edgecolor": _NEUTRAL})
    axes.plot(sustained, places, "|", color="#0072B2", markersize=16, markeredgewidth=2.5, label="sustained")
    axes.set(yticks=places, yticklabels=lengths.index, xlim=(0.0, 1250.0))
    axes.invert_yaxis()
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)


def checks(input: Any, output: Any, params: Any) -> None:
    """What each change does to the lengths (rad/s), by contact and blade. Output: table.

    Inputs: ranking of all speeds; responses base, of all speeds, and others, of every change on fewer speeds.
    """
    ranking = read_ranking(input.ranking).set_index(["scene", "blade"])
    base, rows = {(_scene_of(file), _blade_of(file)): read_judged(file) for file in input.base}, {}
    for (scene, blade), response in base.items():
        rows.setdefault((SCENES[scene], "all speeds"), {})[blade] = danger_cell(response)
        for name, column in SUSTAINED.items():
            rows.setdefault((SCENES[scene], f"sustained alone: {name}"), {})[blade] = (
                f"{ranking.loc[(scene, blade), column]:.0f}"
            )
    for file in input.others:
        response, blade, (change, scene) = read_judged(file), _blade_of(file), _change_of(file)
        on_same = base[scene, blade].sel(speed=response["speed"])
        rows.setdefault((SCENES[scene], GRIDS[scene]), {})[blade] = danger_cell(on_same)
        rows.setdefault((SCENES[scene], change), {})[blade] = danger_cell(response)
    blades = list(dict.fromkeys(blade for _, blade in base))
    cells = [
        [contact, what, *(row[blade] for blade in blades)] for (contact, what), row in sorted(rows.items(), key=_contact_of)
    ]
    write_table(["contact", "what", *blades], cells, output.table)


def _contact_of(row: tuple[tuple[str, str], Any]) -> str:
    return row[0][0]


def _change_of(file: str) -> tuple[str, str]:
    """What the response of a file varies, and the scene that it varies."""
    change, _, contact = _scene_of(file).rpartition("_")
    scene = LINING if contact == "abradable" else BARE
    return TRIED.get(change, "level draft"), scene


def interactions(input: Any, output: Any, params: Any) -> None:
    """Longest dangerous or sustained ranges. Inputs: summary, campbell, base (responses). Outputs: lining, bare (tables)."""
    campbell, summary = read_dataset(input.campbell), read_table(input.summary)
    responses = {(_blade_of(file), _scene_of(file)): read_judged(file) for file in input.base}
    for scene, file in ((LINING, output.lining), (BARE, output.bare)):
        rows = []
        for blade in dict.fromkeys(blade for blade, _ in responses):
            response = responses[blade, scene]
            ranges = joined(ranges_of(response)[LISTED[scene]])
            longest = sorted(sorted(ranges, key=lambda part: -part.length)[:_LONGEST], key=lambda part: part.begin)
            own = summary[(summary["blade"] == blade) & (summary["scene"] == scene)]
            words = ", ".join(f"{part.begin:.0f} to {part.end:.0f} ({_named(part, own, LISTED[scene])})" for part in longest)
            top = own.sort_values("peak_motion_m").tail(1)
            largest = 1e3 * motion(response).max()
            crossings = campbell["crossing_speed"].sel(blade=blade, mode="1B", engine_order=[4, 6]).values
            rows.append([blade, *(f"{crossing:.0f}" for crossing in crossings), words])
            near = sum(_common(part, *(share * crossing for share in NEAR)) for part in ranges for crossing in crossings)
            rows[-1] += [f"{length_of(ranges):.0f}", f"{near:.0f}", f"{largest:.1f}", *(_titles(top) or ["-"])]
        write_table(list(INTERACTIONS), rows, file)


def _common(part: SpeedRange, begin: float, end: float) -> float:
    """Length (rad/s) that a range has in common with speeds from `begin` to `end`."""
    return max(0.0, min(part.end, end) - max(part.begin, begin))


def _named(part: SpeedRange, interactions: pd.DataFrame, column: str) -> str:
    """Length of a range, and the interaction from rest that most of its speeds are of, if one is."""
    begin, end = (interactions[column.replace("length_", "").replace("_rad", f"_{side}_rad")] for side in ("from", "to"))
    common = np.minimum(end, part.end) - np.maximum(begin, part.begin)
    names = _titles(interactions.loc[common[common >= 0.0].nlargest(1).index])
    return ": ".join([f"{part.length:.0f}", *names])


def _titles(interactions: pd.DataFrame) -> list[str]:
    return [interaction_title(*pair) for pair in zip(interactions["mode"], interactions["engine_order"], strict=True)]


def large_motion(input: Any, output: Any, params: Any) -> None:
    """Linear theory beside large displacements. Inputs: linear, quadratic, responses. Outputs: table, picture."""
    runs = {
        name: {(_blade_of(file), _scene_of(file)): read_judged(file) for file in files}
        for name, files in (("linear", input.linear), ("large displacements", input.quadratic))
    }
    rows: dict[str, dict[str, str]] = {}
    for blade, scene in runs["linear"]:
        texts = [_texts(of[blade, scene]) for of in runs.values()]
        for what, pair in zip(MOTION, zip(*texts, strict=True), strict=True):
            rows.setdefault(blade, {})[f"{SCENES[scene]}: {what}"] = " / ".join(pair)
    _write(pd.DataFrame.from_dict(rows, orient="index"), output.table)
    figure, panels = plt.subplots(
        len(DRAWN), len(SCENES), figsize=(style.PAGE, 0.6 * style.PAGE), sharex=True, sharey="row", layout="constrained"
    )
    for row, blade in zip(panels, DRAWN, strict=True):
        for axes, scene in zip(row, (LINING, BARE), strict=True):
            for name, of in runs.items():
                axes.plot(of[blade, scene]["speed"], 1e3 * np.asarray(motion(of[blade, scene])), label=name, linewidth=1.2)
            axes.set_title(f"{blade}, {SCENES[scene]}")
            axes.grid(alpha=0.3)
        # of all curves of the row
        row[0].set_ylim(bottom=0.0)
        row[0].set_ylabel("motion, rms (mm)")
    for axes in panels[-1]:
        axes.set_xlabel("speed (rad/s)")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=2, frameon=False)
    style.save(figure, output.picture)


def _texts(response: xr.Dataset) -> tuple[str, str, str]:
    """Largest motion (mm), its speed (rad/s), and the lengths (rad/s)."""
    moved = motion(response)
    largest = int(np.nanargmax(moved))
    return f"{1e3 * float(moved[largest]):.1f}", f"{float(response['speed'][largest]):.0f}", danger_cell(response)


def _write(cells: pd.DataFrame, file: str) -> None:
    write_table(
        ["blade", *cells], [[str(blade), *row] for blade, row in zip(cells.index, cells.values.tolist(), strict=True)], file
    )


def _blade_of(file: str) -> str:
    return Path(file).parts[-3]


def _scene_of(file: str) -> str:
    return Path(file).parts[-2]
