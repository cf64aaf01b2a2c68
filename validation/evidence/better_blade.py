"""Searches for a better blade: what each gives, all their designs, and checks of the best one."""

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes

from r37core.base.dataset_file import read_dataset
from r37core.figures import style
from r37core.results.columns import ENDS
from r37core.results.other_motions import REST, swept
from r37core.results.ranking import robustness
from r37core.results.regions import read_judged
from r37core.search.problem import START
from r37core.time_integration.status import RunStatus

from .pages import write_table
from .which_blade import length_text

BLADE, BARE = "Free", "bare"
"""Blade that the searches start at, and their constraint of the bare casing."""

SCENES = {"material_abradable": "lining", "direct": "bare casing"}
"""Scene -> its name on the page."""

INTEGRAL = "exceedance_integral"


def searches(input: Any, output: Any, params: Any) -> None:
    """The start and the best design of each search. Input: searches. Params: searches, file -> its name. Output: table."""
    rows = []
    for file, words in zip(input.searches, params.searches.values(), strict=True):
        search = read_dataset(file)
        if not rows:
            rows.append([f"none: {BLADE}", "", *_design(search, START, Path(file).parent)])
        feasible = (
            f"{int(search['feasible'].sum()) - int(search['feasible'].sel(design=START))} of {search.sizes['design'] - 1}"
        )
        name = best_of(search)
        rows.append([words, feasible, *(_design(search, name, Path(file).parent) if name else [""] * len(rows[0][2:]))])
    head = ["search", "keep all constraints", "lining (rad/s)", "bare casing (rad/s)", "mass (%)", "1B (%)"]
    write_table(head, rows, output.table)


def best_of(search: xr.Dataset) -> str | None:
    """Name of the best design; None where none keeps all constraints."""
    best = search["design"].values[search["order"].values == 1]
    return str(best[0]) if len(best) else None


def _design(search: xr.Dataset, name: str, folder: Path) -> list[str]:
    """Integrals in both scenes, and mass and frequency in percent of the start's."""
    of_design = search.sel(design=name)
    cells = [integral_text(folder / "search" / name / BLADE / scene / "response.nc") for scene in SCENES]
    relative = 100.0 * of_design["constraint_value"] / search["constraint_value"].sel(design=START)
    return [*cells, *(f"{float(relative.sel(constraint=constraint)):.1f}" for constraint in ("mass", "first_bending"))]


def integral_text(file: Path) -> str:
    """Integral of the share of revolutions above yield (rad/s) of a response, with its scatter by chance."""
    measures = robustness(read_judged(file))
    return length_text(measures[f"{INTEGRAL}_rad_s"], measures[f"{INTEGRAL}_scatter_rad_s"])


def designs(input: Any, output: Any, params: Any) -> None:
    """All designs of all searches. Input: searches. Params: searches, file -> its name. Outputs: table, picture."""
    parts = []
    for file, words in zip(input.searches, params.searches.values(), strict=True):
        search = read_dataset(file)
        part = pd.DataFrame({"search": words, "design": search["design"].values})
        part["lined"] = search["objective_value"].sel(objective="lined").values
        for name in search["constraint"].values:
            part[str(name)] = search["constraint_value"].sel(constraint=name).values
        for key in search["variable"].values:
            part[str(key)] = search["value"].sel(variable=key).values
        part["keeps"] = _keeps_others(search)
        parts.append(part)
    table = pd.concat(parts, ignore_index=True)
    rows = table.map(lambda cell: f"{cell:.4g}" if isinstance(cell, float) else str(cell))
    write_table([*table.columns[:-1], "keeps all but bare"], rows.values.tolist(), output.table)
    _picture(table, output.picture)


def _keeps_others(search: xr.Dataset) -> np.ndarray:
    """Whether each design keeps all constraints but that of the bare casing, which is an axis of the picture."""
    others = search.sel(constraint=[name for name in search["constraint"].values if name != BARE])
    inside = (others["constraint_value"] >= others["constraint_lowest"]) & (
        others["constraint_value"] <= others["constraint_highest"]
    )
    return inside.all("constraint").values


def _picture(table: pd.DataFrame, file: Path | str) -> None:
    figure, panels = plt.subplots(1, 2, figsize=(style.PAGE, 3.4))
    start = table[table["design"] == START].iloc[0]
    tried = table[table["design"] != START]
    feasible = tried[tried["keeps"] & (tried[BARE] <= start[BARE])].sort_values("lined")
    for axes in panels:
        _draw_designs(axes, tried, start)
        best: dict[str, Any] = {"color": style.COLOURS[3], "markersize": 9, "zorder": 6, "linestyle": "none"}
        axes.plot(feasible["lined"][:1], feasible[BARE][:1], marker="*", label="best design", **best)
        axes.set_xlabel("integral on lining (rad/s)")
    panels[0].set_ylabel("integral in a bare casing (rad/s)")
    lowest = min(feasible["lined"].min(), start["lined"])
    panels[1].set_xlim(lowest - 60.0, start["lined"] + 60.0)
    panels[1].set_ylim(-4.0, 2.5 * start[BARE])
    panels[1].set_title("near the start", fontsize=8)
    figure.legend(*style.legend_entries(panels), loc="outside lower center", ncols=4)
    figure.savefig(file)
    plt.close(figure)


def _draw_designs(axes: Axes, tried: pd.DataFrame, start: pd.Series) -> None:
    """Designs by both integrals; filled where they keep the other constraints; those in the box are better in both."""
    for number, (words, part) in enumerate(tried.groupby(tried["search"].str.split(",").str[0], sort=False)):
        for keeps, kept in part.groupby("keeps"):
            fill = style.COLOURS[number] if keeps else "none"
            look = {"marker": "o", "s": 14, "edgecolors": style.COLOURS[number], "facecolors": fill, "linewidths": 0.7}
            label = words if keeps else f"{words}, breaks another constraint"
            axes.scatter(kept["lined"], kept[BARE], label=label, **look)
    axes.plot(start["lined"], start[BARE], "s", color="0.15", markersize=5, label=BLADE, zorder=5)
    axes.axvline(start["lined"], color="0.6", linewidth=0.8, linestyle="--")
    axes.axhline(start[BARE], color="0.6", linewidth=0.8, linestyle="--")


def checks(input: Any, output: Any, params: Any) -> None:
    """The start and some best designs at another level. Inputs: motions, rotors. Output: table. Params: folder, blades (words).

    Integrals of all members, of the motion from rest and of the worst of all motions at each speed; lengths of rotors.
    """
    motions, folder = read_dataset(input.motions), Path(params.folder)
    cells: dict[str, list[str]] = {}
    for scene, words in SCENES.items():
        start = _members(folder, BLADE, scene)
        for blade in params.blades:
            members, (rest, worst) = _members(folder, blade, scene), _motions(motions.sel(blade=blade, scene=scene))
            better = sum(members[member] < value for member, value in start.items())
            share = "" if blade == BLADE else f"; better in {better} of {len(start)}"
            cells.setdefault(f"{words}: from rest, worst motion", []).append(f"{rest}, {worst}")
            cells.setdefault(f"{words}: members", []).append(f"{_range(members)}{share}")
    cells["rotor"] = [_rotor(read_dataset(file)) for file in input.rotors]
    rows = [[name, *row] for name, *row in zip(params.blades.values(), *cells.values(), strict=True)]
    write_table(["rad/s", *cells], rows, output.table)


def _members(folder: Path, blade: str, scene: str) -> dict[str, float]:
    """Member -> its integral (rad/s)."""
    files = sorted(folder.glob(f"tolerances/{blade}/{scene}/*/response.nc"))
    return {file.parent.name: robustness(read_judged(file), chance_scatter=False)[f"{INTEGRAL}_rad_s"] for file in files}


def _range(values: dict[str, float]) -> str:
    low, high = np.quantile(list(values.values()), [ENDS["low"], ENDS["high"]], method="inverted_cdf")
    return f"{low:.0f} to {high:.0f}"


def _motions(pair: xr.Dataset) -> list[str]:
    """Integrals (rad/s) of the motion from rest and of the worst of all motions, on the speeds of the sweeps."""
    pair = swept(pair)
    shares = pair["share_of_revolutions_above_yield"].where(pair["status"] != RunStatus.DIVERGED, 1.0)
    several = shares.sel(motion=REST), shares.max("motion")
    return [f"{float(share.integrate('speed')):.0f}" for share in several]


def _rotor(rotor: xr.Dataset) -> str:
    """Length (rad/s) of the speeds with a blade above yield in the last revolution; in brackets integral of their share.

    All are above it where the run diverged.
    """
    shares = rotor["blades_ever_above_yield"].where(rotor["status"] != RunStatus.DIVERGED, 1.0)
    some, share = (float(part.integrate("speed")) for part in ((shares > 0.0).astype(float), shares))
    return f"{some:.0f} ({share:.0f})"
