"""The lining by its material: bars, step and contact nodes, and what the contact length does (docs/lining.md)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from r37core.figures.style import plt, save
from r37core.results.events import Danger, exit_of, yield_events
from r37core.rom.reduction_choice import EVEN

from .accuracy import SHARES, percent
from .blade_runs import Models, mesh_of, numbers_of_run, reduced_model, speeds_about_crossing, with_friction
from .configuration import settings_of
from .tables import write_table

SCENE, LEVEL = "material_abradable", "draft"
CONTACT_LENGTHS = (0.5e-4, 1.585e-4, 5e-4, 1e-3)
"""(m) From a third of the published model's to a tip's thickness."""

FIRST, LAST, STEP = 750.0, 2000.0, 25.0
"""Speeds (rad/s) of the lengths."""


def limits(input: Any, output: Any, params: Any) -> None:
    """Changes of rms and wear by bars, step, patches and chance, about 1B/4 of some blades. Params: configuration, blades."""
    settings = settings_of(Path.cwd(), **params.configuration, fidelity=LEVEL)
    scene = settings.scenes[SCENE].scene
    cells: dict[str, list[str]] = {}
    for blade in params.blades:
        mesh = mesh_of(settings, blade)
        usual, fewer, more = (
            Models.of(reduced_model(mesh, settings, blade, **boundary), settings, blade)
            for boundary in ({}, {"nodes": 8}, {"nodes": 20, "spacing": EVEN})
        )
        speeds = speeds_about_crossing(usual.contact, SHARES)

        def runs(models: Models, varied: Any = scene, step: float = 1.0, blade: str = blade, at: Any = speeds) -> list[Any]:
            choice = settings.integration_choice(blade, SCENE)
            choice = replace(choice, time_step=step * choice.time_step)
            return [numbers_of_run(models, speed, varied, choice, "wear") for speed in at]

        cases = {
            "2,500 bars in place of 10,000": runs(usual, with_bars(scene, 2500)),
            "40,000 bars": runs(usual, with_bars(scene, 40_000)),
            "a quarter of the step": runs(usual, step=0.25),
            "8 patches in place of 11": runs(fewer),
            "20 even patches": runs(more),
            "friction + 0.1%": runs(usual, with_friction(scene, 1.001)),
        }
        base = runs(usual)
        for case, varied in cases.items():
            cells.setdefault(case, []).append(changes(varied, base))
    write_table(["case", *(f"{blade}: rms, median; largest; wear" for blade in params.blades)], cells_of(cells), output.table)


def cells_of(cells: Mapping[str, list[str]]) -> list[list[str]]:
    """Rows of a table from cells by case."""
    return [[case, *row] for case, row in cells.items()]


def with_bars(scene: Any, bars: int) -> Any:
    """The scene with another number of bars."""
    return replace(scene, lining=replace(scene.lining, bars=bars))


def changes(varied: list[Any], base: list[Any]) -> str:
    """Median and largest change of the rms over the speeds, and median change of the profile of wear over its largest."""
    motion = [100.0 * abs(run["motion"] / other["motion"] - 1.0) for run, other in zip(varied, base, strict=True)]
    wear = [
        100.0 * np.abs(run["wear"] - other["wear"]).mean() / max(other["wear"].max(), 1e-12)
        for run, other in zip(varied, base, strict=True)
    ]
    return f"{percent(np.median(motion))}; {percent(np.max(motion))}; {percent(np.median(wear))}"


def contact_lengths_of_blade(input: Any, output: Any, params: Any) -> None:
    """Dangerous and unknown lengths of a blade at each of CONTACT_LENGTHS. Params: configuration, blade. Output: lengths."""
    settings = settings_of(Path.cwd(), **params.configuration, fidelity=LEVEL)
    scene, limit = settings.scenes[SCENE].scene, settings.blades[params.blade].material.yield_stress
    models = Models.of(reduced_model(mesh_of(settings, params.blade), settings, params.blade), settings, params.blade)
    rows = []
    for length in CONTACT_LENGTHS:
        other = replace(scene, lining=replace(scene.lining, contact_length=length))
        dangers: list[int] = []
        for speed in np.arange(FIRST, LAST + 1.0, STEP):
            run = numbers_of_run(models, float(speed), other, settings.integration_choice(params.blade, SCENE))
            dangers.append(int(yield_events(run, limit, exit_of(run)["exit_revolution"])["yield_danger"][0]))
        dangerous, unknown = (STEP * dangers.count(danger) for danger in (Danger.DANGEROUS, Danger.UNKNOWN))
        rows.append({"blade": params.blade, "mm": 1e3 * length, "dangerous": dangerous, "unknown": unknown})
    pd.DataFrame(rows).to_csv(output.lengths, index=False)


def spread(heights: Mapping[str, float], least: float) -> dict[str, float]:
    """Heights of labels, in the order of those of their curves, at `least` so far apart."""
    places: dict[str, float] = {}
    for name, height in sorted(heights.items(), key=lambda each: each[1]):
        places[name] = max(height, max(places.values(), default=-np.inf) + least)
    return places


def contact_lengths(input: Any, output: Any, params: Any) -> None:
    """Lengths of all blades at each contact length, and their picture. Input: files of contact_lengths_of_blade."""
    table = pd.concat([pd.read_csv(file) for file in input.files])
    table["cell"] = [f"{row.dangerous:.0f} / {row.unknown:.0f}" for row in table.itertuples()]
    cells = table.pivot(index="blade", columns="mm", values="cell").loc[table["blade"].unique()]
    rows = [[str(blade), *row] for blade, row in zip(cells.index, cells.values.tolist(), strict=True)]
    write_table(["blade", *(f"{length:.3g} mm" for length in cells)], rows, output.table)
    figure, panels = plt.subplots(1, 2, figsize=(6.4, 3.2), sharex=True, layout="constrained")
    for axes, kind in zip(panels, ("dangerous", "unknown"), strict=True):
        lengths = table.pivot(index="mm", columns="blade", values=kind)
        heights = spread(lengths.iloc[-1].to_dict(), 0.075 * float(max(lengths.to_numpy().max(), STEP)))
        for blade in cells.index:
            (line,) = axes.semilogx(lengths.index, lengths[blade], "o-", markersize=4)
            place = (1.1 * lengths.index[-1], heights[blade])
            axes.annotate(str(blade), place, color=line.get_color(), va="center", annotation_clip=False, fontsize=9)
        axes.set(xlabel="contact length (mm)", ylabel=f"{kind} speeds (rad/s)")
        axes.set_xticks(lengths.index, [f"{length:.3g}" for length in lengths.index])
        axes.minorticks_off()
    save(figure, output.picture)
