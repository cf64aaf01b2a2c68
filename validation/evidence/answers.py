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
from r37core.results.columns import MOST_REVOLUTIONS
from r37core.results.exceedance import Exceedance, SpeedRange, exceedance_of, joined
from r37core.results.measures import motion
from r37core.results.other_motions import swept
from r37core.results.ranking import read_ranking
from r37core.results.regions import read_judged
from r37core.results.table_file import read_table
from r37studies.second_motions.added import worst_exceedance

from .tables import write_table

LINING, BARE = "material_abradable", "direct"
SCENES = {BARE: "bare casing", LINING: "abradable lining"}
TRIED = {"twice": "twice as long", "friction": "0.1% more friction", "elastic": "flexible casing"}
"""Scenes of the cases by the beginning of their names, and what they vary."""

LENGTH, WORST = "length_most_revolutions_rad_s", "length_most_revolutions_worst_rad_s"
REGIONS = {"box at the root alone": "_box", "modes above 7.5 kHz, too": "_airfoil_unfiltered"}
"""Regions of the stress, and the part of a column's name."""

DRAWN = ("Ref", "S100")
"""Blades whose motion is drawn: without sweep, and with most of it."""

INTERACTIONS = (
    *("blade", "1B/4 at (rad/s)", "1B/6 at (rad/s)", "three longest ranges above yield (rad/s)", "all ranges (rad/s)"),
    *("largest motion (mm)", "largest from rest"),
)
"""Columns of the tables of interactions: ranges and motion from rest or by the worst motion, the last one from rest."""

MOTION = ("largest motion (mm)", "at (rad/s)", "above yield (rad/s)")
"""Columns of the table of large motion, for each contact."""

_LONGEST = 3
_NEUTRAL = "#767676"  # letters and lines that can be read on a white and on a dark page
_ON_ANY_PAGE: dict[Any, Any] = {
    **dict.fromkeys(("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color"), _NEUTRAL),
    **dict.fromkeys(("figure.facecolor", "axes.facecolor"), "none"),
    **{f"{name}size": 10 for name in ("font.", "axes.title", "axes.label", "xtick.label", "ytick.label", "legend.font")},
    "grid.color": _NEUTRAL,
}


def draw(input: Any, output: Any, params: Any) -> None:
    """Lengths above yield by blade, from rest and by the worst motion. Inputs: ranking, linear. Outputs: table, picture."""
    ranking, linear = (read_ranking(file).set_index(["scene", "blade"]) for file in (input.ranking, input.linear))
    columns: dict[str, pd.Series] = {}
    for scene, words in SCENES.items():
        columns[f"{words}: from rest"] = ranking.loc[scene, LENGTH]
        columns[f"{words}: worst motion"] = ranking.loc[scene, WORST]
        columns[f"{words}: linear"] = linear.loc[scene, LENGTH]
    lengths = pd.DataFrame(columns).sort_values("bare casing: worst motion").round()
    _write(lengths.map("{:.0f}".format), output.table)
    with plt.rc_context(_ON_ANY_PAGE):
        figure, panels = plt.subplots(2, 1, figsize=(5.2, 5.0), sharex=True)
        for axes, words in zip(panels, SCENES.values(), strict=True):
            _bars(axes, lengths[f"{words}: from rest"], lengths[f"{words}: worst motion"])
            axes.set_title(words, loc="left", fontweight="bold")
        panels[-1].set_xlabel("speeds above yield, of 1,250 rad/s")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2, handlelength=1.2)
        style.save(figure, output.picture, dots_per_inch=150)


def _bars(axes: Axes, rest: pd.Series, worst: pd.Series) -> None:
    """Two bars on each other for each blade, the best blade at the top."""
    places = np.arange(len(rest), dtype=float)
    axes.barh(places, worst, 0.6, color="#F2C6A7", label="worst of three motions")
    axes.barh(places, rest, 0.6, color="#D55E00", label="from rest")
    for place, length in zip(places, worst, strict=True):
        axes.annotate(f"{length:.0f}", (length, place), (5, 0), textcoords="offset points", va="center", fontsize=9)
    axes.set(yticks=places, yticklabels=rest.index, xlim=(0.0, 1250.0))
    axes.invert_yaxis()
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)


def checks(input: Any, output: Any, params: Any) -> None:
    """What each change does to the lengths above yield (rad/s), by contact and blade. Output: table.

    Inputs: ranking and motions of all speeds; responses base, bare and draft; lined and lined_draft, motions of all blades and
    of those that have their 1B/4 elsewhere.
    """
    rows: dict[tuple[str, str], dict[str, float]] = {}
    ranking = read_ranking(input.ranking).set_index(["scene", "blade"])
    every, coarse = read_dataset(input.motions), _speeds_of(input.bare[0])
    for scene, words in SCENES.items():
        rows[words, "all speeds, worst motion"] = dict(ranking.loc[scene, WORST])
        rows[words, "all speeds, from rest"] = dict(ranking.loc[scene, LENGTH])
        files = [file for file in input.base if _scene_of(file) == scene]
        for step, speeds in {"5": every["speed"].values, "50": coarse}.items():
            rows[words, f"every {step} rad/s, from rest"] = _lengths(files, speeds)
        for name, part in REGIONS.items():
            rows[words, f"{name}, from rest"] = dict(ranking.loc[scene, LENGTH.replace("_rad", f"{part}_rad")])
    responses = {"level draft": list(input.draft)}
    for file in input.bare:
        responses.setdefault(TRIED[_scene_of(file).split("_")[0]], []).append(file)
    for name, files in responses.items():
        rows[SCENES[BARE], name] = _lengths(files, coarse)
    for cases, draft in zip(map(read_dataset, input.lined), map(read_dataset, input.lined_draft), strict=True):
        about = {"blade": cases["blade"].values, "speed": cases["speed"].values}
        motions = {"about 1B/4 every 5 rad/s": (every, LINING), "level draft": (draft, LINING)}
        lined = [str(scene) for scene in cases["scene"].values if str(scene).endswith("_abradable")]
        motions |= {TRIED[scene.split("_")[0]]: (cases, scene) for scene in lined}
        for name, (dataset, scene) in motions.items():
            rows.setdefault((SCENES[LINING], name), {}).update(_worst_lengths(dataset.sel(about), scene))
    table = pd.DataFrame(rows).T.rename_axis(["contact", "what"]).sort_index(level=0, sort_remaining=False, kind="stable")
    table.insert(0, "order", [", ".join(row.sort_values(kind="stable").index) for _, row in table.iterrows()])
    text = table.map(lambda cell: cell if isinstance(cell, str) else f"{cell:.0f}").reset_index()
    write_table(list(text.columns), text.astype(str).values.tolist(), output.table)


def _lengths(files: list[str], speeds: np.ndarray) -> dict[str, float]:
    """Lengths of blades from rest, at some of the speeds of their responses."""
    return {_blade_of(file): exceedance_of(read_judged(file).sel(speed=speeds)).length(MOST_REVOLUTIONS) for file in files}


def _worst_lengths(motions: xr.Dataset, scene: str) -> dict[str, float]:
    return {blade: _worst(motions, blade, scene).length(MOST_REVOLUTIONS) for blade in _blades(motions)}


def _worst(motions: xr.Dataset, blade: str, scene: str) -> Exceedance:
    """Exceedance of the worst motion of a blade in a scene."""
    return worst_exceedance(swept(motions.sel(blade=blade, scene=scene)))


def interactions(input: Any, output: Any, params: Any) -> None:
    """Longest ranges above yield, by the worst motion or, if longer in all, from rest at all speeds.

    Inputs: motions, summary, campbell, base, responses from rest. Outputs: lining, bare, tables.
    """
    motions, campbell = read_dataset(input.motions), read_dataset(input.campbell)
    summary = read_table(input.summary)
    from_rest = {(_blade_of(file), _scene_of(file)): read_judged(file) for file in input.base}
    for scene, file in ((LINING, output.lining), (BARE, output.bare)):
        rows = []
        for blade in _blades(motions):
            response = from_rest[blade, scene]
            either = (_worst(motions, blade, scene), exceedance_of(response))
            ranges = joined(max(either, key=lambda worst: worst.length(MOST_REVOLUTIONS)).ranges(MOST_REVOLUTIONS))
            longest = sorted(sorted(ranges, key=lambda part: -part.length)[:_LONGEST], key=lambda part: part.begin)
            own = summary[(summary["blade"] == blade) & (summary["scene"] == scene)]
            words = ", ".join(f"{part.begin:.0f} to {part.end:.0f} ({_named(part, own)})" for part in longest)
            top = own.sort_values("peak_motion_m").tail(1)
            largest = 1e3 * max(motion(response).max(), float(motions.sel(blade=blade, scene=scene)["motion_mean"].max()))
            crossings = campbell["crossing_speed"].sel(blade=blade, mode="1B", engine_order=[4, 6]).values
            rows.append([blade, *(f"{crossing:.0f}" for crossing in crossings), words])
            rows[-1] += [f"{sum(part.length for part in ranges):.0f}", f"{largest:.1f}", *(_titles(top) or ["-"])]
        write_table(list(INTERACTIONS), rows, file)


def _named(part: SpeedRange, interactions: pd.DataFrame) -> str:
    """Length of a range, and the interaction from rest that most of its speeds are of, if one is."""
    begin, end = (interactions[f"some_revolutions_{side}_rad_s"] for side in ("from", "to"))
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
    """Largest motion (mm), its speed (rad/s), and the length above yield (rad/s)."""
    moved = motion(response)
    largest = int(np.nanargmax(moved))
    length = exceedance_of(response).length(MOST_REVOLUTIONS)
    return f"{1e3 * float(moved[largest]):.1f}", f"{float(response['speed'][largest]):.0f}", f"{length:.0f}"


def _write(cells: pd.DataFrame, file: str) -> None:
    write_table(
        ["blade", *cells], [[str(blade), *row] for blade, row in zip(cells.index, cells.values.tolist(), strict=True)], file
    )


def _blades(motions: xr.Dataset) -> list[str]:
    return [str(blade) for blade in motions["blade"].values]


def _blade_of(file: str) -> str:
    return Path(file).parts[-3]


def _scene_of(file: str) -> str:
    return Path(file).parts[-2]


def _speeds_of(file: str) -> np.ndarray:
    return read_judged(file)["speed"].values
