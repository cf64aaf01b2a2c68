"""Stress of the airfoil against the highest frequency kept, with other damping of high modes, step and casing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from r37core.config import Settings
from r37core.contact.scene import DampingTable, Scene
from r37core.figures.style import PAGE, plt, save

from .blade_runs import AIRFOIL, Models, mesh_of, numbers_of_run, reduced_model
from .configuration import settings_of
from .tables import write_table

BARE, LINED, ELASTIC = "direct", "material_abradable", "elastic_direct"
HIGHEST, KEPT = 7500.0, (3000.0, 5000.0, 7500.0, 10_000.0, 15_000.0, 25_000.0, 50_000.0)
"""Highest frequency (Hz) of the region that decides, and those that are compared."""

USUAL = "as shipped"


@dataclass(frozen=True)
class Place:
    """A blade in a scene at a speed (rad/s), and its name."""

    name: str
    blade: str
    scene: str
    speed: float


PLACES = (
    Place("Ref, bare, 1330 rad/s", "Ref", BARE, 1330.0),
    Place("S100, bare, 1867 rad/s", "S100", BARE, 1867.0),
    Place("Ref, lining, 1700 rad/s", "Ref", LINED, 1700.0),
)


def models_of(settings: Settings, blade: str) -> Models:
    """Models of a blade with a region for each frequency of KEPT."""
    shipped = settings.stress_regions(blade)[AIRFOIL]
    regions = {f"{kept:g}": replace(shipped, highest_frequency=kept) for kept in KEPT}
    return Models.of(reduced_model(mesh_of(settings, blade), settings, blade, regions), settings, blade)


def cases_of(scene: Scene, ring: Scene) -> Iterator[tuple[str, Scene, float]]:
    """Cases in words, their scenes, and shares of the level's step. `ring`: a scene with the elastic casing."""
    yield USUAL, scene, 1.0
    assert isinstance(scene.damping_ratio, float)
    for factor in (3, 10):
        table = DampingTable((HIGHEST, HIGHEST + 1.0), (scene.damping_ratio, factor * scene.damping_ratio))
        yield f"modes above 7.5 kHz damped {factor} times as much", replace(scene, damping_ratio=table), 1.0
    yield "half the step", scene, 0.5
    casing = replace(scene.casing, ring=ring.casing.ring, ring_radius=ring.casing.ring_radius)
    yield "elastic casing", replace(scene, casing=casing), 1.0


def table_and_picture(input: Any, output: Any, params: Any) -> None:
    """Median of the largest stress of a revolution over yield in all cases, and its picture. Params: configuration."""
    settings = settings_of(Path.cwd(), **params.configuration, fidelity="draft")
    ring = settings_of(Path.cwd(), scenes=[ELASTIC]).scenes[ELASTIC].scene
    models = {blade: models_of(settings, blade) for blade in dict.fromkeys(place.blade for place in PLACES)}
    curves: dict[str, dict[str, np.ndarray]] = {}
    for place in PLACES:
        limit = settings.blades[place.blade].material.yield_stress
        usual = settings.integration_choice(place.blade, place.scene)
        for case, scene, share in cases_of(settings.scenes[place.scene].scene, ring):
            choice = replace(usual, time_step=share * usual.time_step)
            run = numbers_of_run(models[place.blade], place.speed, scene, choice)
            curves.setdefault(place.name, {})[case] = run["largest"] / limit
    head = ["place", "case", *(f"up to {kept / 1e3:g} kHz" for kept in KEPT)]
    rows = [[place, case, *(f"{value:.2f}" for value in values)] for place, of in curves.items() for case, values in of.items()]
    write_table(head, rows, output.table)
    _draw(curves, output.picture)


def _draw(curves: dict[str, dict[str, np.ndarray]], file: str) -> None:
    figure, panels = plt.subplots(1, len(curves), figsize=(PAGE, 2.7))
    for axes, (place, cases) in zip(panels, curves.items(), strict=True):
        for case, values in cases.items():
            axes.semilogx(np.array(KEPT) / 1e3, values, ".-", label=case)
        axes.axvline(HIGHEST / 1e3, color="0.6", linewidth=0.8, zorder=0)
        axes.set_title(place)
        axes.set_xlabel("highest frequency kept (kHz)")
        axes.set_xticks([3, 7.5, 15, 50], ["3", "7.5", "15", "50"])
        axes.minorticks_off()
    panels[0].set_ylabel("largest stress / yield")
    for axes in panels:
        axes.set_ylim(0.0, None)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    save(figure, file)
