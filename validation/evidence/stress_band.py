"""Stress of the airfoil against the highest frequency kept, the damping of high modes, step, patches and an elastic casing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from r37core.config import Settings
from r37core.contact.scene import DampingTable, Scene
from r37core.fem.matrices import assemble
from r37core.figures.style import PAGE, plt, save
from r37core.mesh.generate import generate_mesh
from r37core.rom.contact_model import ContactModel
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import COSINE, EVEN, PATCHES
from r37core.stress.operator import StressOperators
from r37core.stress.recovery import stress_operators
from r37core.time_integration.speed_run import run_speed

from .configuration import settings_of
from .contact_runs import TIP_ELEMENTS
from .pages import write_table

BARE, LINED, ELASTIC = "direct", "material_abradable", "elastic_direct"
AIRFOIL, HIGHEST, KEPT = "airfoil", 7500.0, (3000.0, 5000.0, 7500.0, 10_000.0, 15_000.0, 25_000.0, 50_000.0)
"""Region that decides, its highest frequency (Hz), and those that are compared."""

MESH, USUAL, SPACINGS = 5000, 11, {8: COSINE, 11: COSINE, 20: EVEN}
"""Nodes of the level's mesh, patches on it by default, and how each number of patches is spaced."""

DAMPING, STEPS = (1, 3, 10, 30), (3.2e-6, 1.6e-6)
"""Factors on the damping ratio of modes above HIGHEST, and steps (s) shorter than that of the level."""


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
    Place("Ref, lining, 1720 rad/s", "Ref", LINED, 1720.0),
)


@dataclass(frozen=True)
class Models:
    """Models for contact and stress: a region for each frequency of KEPT."""

    contact: ContactModel
    stress: StressOperators


def models_of(settings: Settings, blade: str) -> dict[int, Models]:
    """Models of a blade by their number of patches."""
    chosen, reduction, made = settings.blades[blade], settings.reduction_choice(blade), {}
    regions = {f"{kept:g}": replace(settings.stress_regions(blade)[AIRFOIL], highest_frequency=kept) for kept in KEPT}
    mesh = generate_mesh(chosen.definition.build(round_edges=True), MESH, 1, TIP_ELEMENTS[MESH])
    matrices = assemble(mesh, chosen.material)
    for count, spacing in SPACINGS.items():
        boundary = replace(settings.boundary_choice(blade), contact=PATCHES, nodes=count, spacing=spacing)
        reduced = reduce_blade(mesh, matrices, chosen.material, boundary, reduction, regions)
        made[count] = Models(contact_model(reduced, boundary.tip_line), stress_operators(reduced, chosen.material))
    return made


def high_modes_damped(scene: Scene, factor: float) -> Scene:
    """The scene with more damping of modes above HIGHEST."""
    ratio = scene.damping_ratio
    assert isinstance(ratio, float)
    return replace(scene, damping_ratio=DampingTable((HIGHEST, HIGHEST + 1.0), (ratio, factor * ratio)))


def cases_of(scene: Scene, ring: Scene) -> Iterator[tuple[str, float, int, Scene, float | None]]:
    """What is varied, its value, patches, scene and step (s; None: the level's), the usual case first."""
    yield "usual", 1.0, USUAL, scene, None
    for factor in DAMPING[1:]:
        yield "damping", factor, USUAL, high_modes_damped(scene, factor), None
    for step in STEPS:
        yield "step", 1e6 * step, USUAL, scene, step
    for count in SPACINGS:
        if count != USUAL:
            yield "patches", count, count, scene, None
    casing = replace(scene.casing, ring=ring.casing.ring, ring_radius=ring.casing.ring_radius)
    yield "elastic", 1.0, USUAL, replace(scene, casing=casing), None


def runs(input: Any, output: Any, params: Any) -> None:
    """Median over the later revolutions of the largest stress over yield, of every place, case and frequency kept."""
    settings, rows = settings_of(Path.cwd(), fidelity="draft", scenes=[BARE, LINED, ELASTIC]), []
    models = {blade: models_of(settings, blade) for blade in dict.fromkeys(place.blade for place in PLACES)}
    ring = settings.scenes[ELASTIC].scene
    for place in PLACES:
        limit = settings.blades[place.blade].material.yield_stress
        usual = settings.integration_choice(place.blade, place.scene, place.speed)
        for what, value, count, scene, step in cases_of(settings.scenes[place.scene].scene, ring):
            of_blade, choice = models[place.blade][count], usual if step is None else replace(usual, time_step=step)
            sizes = {"spectrum_highest_order": 1, "wear_angles": 8}
            run = run_speed(of_blade.contact, place.speed, scene, choice, ("stress",), stress=of_blade.stress, **sizes)
            medians = np.median(run["revolution_von_mises"], axis=1) / limit
            row = {"place": place.name, "what": what, "value": value, "step": 1e6 * float(run["time_step"])}
            rows.append(row | {f"{kept:g}": median for kept, median in zip(KEPT, medians, strict=True)})
    pd.DataFrame(rows).to_csv(output[0], index=False)


def in_words(row: Any) -> str:
    """A row's case as the table has it."""
    words = {"damping": "modes above 7.5 kHz damped {:g} times as much", "patches": "{:g} patches", "step": "step {:g} us"}
    words |= {"usual": f"as shipped: {USUAL} patches", "elastic": "elastic casing"}
    return words[row["what"]].format(row["value"])


def table_and_picture(input: Any, output: Any, params: Any) -> None:
    """Table of all cases, and their picture. Input: file of runs. Output: table, picture."""
    found = pd.read_csv(input.files[0])
    head = ["place", "case", "step (us)", *(f"up to {kept / 1e3:g} kHz" for kept in KEPT)]
    rows = [
        [row["place"], in_words(row), f"{row['step']:.1f}", *(f"{row[f'{kept:g}']:.2f}" for kept in KEPT)]
        for _, row in found.iterrows()
    ]
    write_table(head, rows, output.table)
    figure, panels = plt.subplots(2, 3, figsize=(PAGE, 4.4), sharey=True)
    groups = {place.name: found[found.place == place.name] for place in PLACES}
    _draw_kept(panels[0, 0], groups)
    _draw_damped(panels[0, 1], groups[PLACES[0].name])
    titles = {"damping": "damping ratio of modes above 7.5 kHz", "step": "step (us)", "patches": "patches", "elastic": "casing"}
    for axes, (what, title) in zip(panels.flat[2:], titles.items(), strict=True):
        _draw_influence(axes, groups, what)
        axes.set_xlabel(title)
    panels[0, 2].set_title("solid: up to 50 kHz, dashed: 7.5 kHz", loc="left")
    for axes in panels[:, 0]:
        axes.set_ylabel("largest stress / yield")
    panels[0, 0].set_ylim(0.0, None)
    save(figure, output.picture)


def _along_kept(axes: Any, row: Any, colour: str) -> list[float]:
    values = [row[f"{kept:g}"] for kept in KEPT]
    axes.semilogx(np.array(KEPT) / 1e3, values, ".-", color=colour)
    return values


def _draw_kept(axes: Any, groups: Mapping[str, pd.DataFrame]) -> None:
    for number, (name, group) in enumerate(groups.items()):
        top = max(_along_kept(axes, group.iloc[0], f"C{number}"))
        axes.annotate(name, (50, top), (0, 4), textcoords="offset points", color=f"C{number}", ha="right", fontsize=7)
    axes.set_title("as shipped", loc="left")
    _mark_kept(axes)


def _draw_damped(axes: Any, group: pd.DataFrame) -> None:
    cases = group[group.what.isin(["usual", "damping"])]
    for number, ((_, row), side) in enumerate(zip(cases.iterrows(), ("center", "center", "bottom", "top"), strict=True), 3):
        last = _along_kept(axes, row, f"C{number}")[-1]
        axes.annotate(f"x{row.value:g}", (57, last), color=f"C{number}", va=side, fontsize=7)
    axes.set_xlim(None, 90.0)
    axes.set_title("Ref, bare: damping above 7.5 kHz", loc="left")
    _mark_kept(axes)


def _mark_kept(axes: Any) -> None:
    axes.axvline(HIGHEST / 1e3, color="0.6", lw=0.8, zorder=0)
    axes.set_xlabel("highest frequency kept (kHz)")
    axes.set_xticks([3, 7.5, 15, 50], ["3", "7.5", "15", "50"])
    axes.minorticks_off()


def _draw_influence(axes: Any, groups: Mapping[str, pd.DataFrame], what: str) -> None:
    """Stress over one influence: solid with all modes up to 50 kHz, dashed with those that decide."""
    for number, group in enumerate(groups.values()):
        usual = group.iloc[[0]].assign(value={"patches": USUAL, "elastic": 0.0}.get(what, 1.0))
        rows = pd.concat([usual, group[group.what == what]]).sort_values("step" if what == "step" else "value")
        places = rows.step if what == "step" else rows.value
        for kept, dashes in ((KEPT[-1], "-"), (HIGHEST, "--")):
            axes.plot(places, rows[f"{kept:g}"], dashes, marker=".", color=f"C{number}")
    if what == "damping":
        axes.set_xscale("log")
        axes.set_xticks(DAMPING, [f"x{factor}" for factor in DAMPING])
        axes.minorticks_off()
    if what == "patches":
        axes.set_xticks(list(SPACINGS))
    if what == "elastic":
        axes.set_xticks([0, 1], ["rigid", "elastic"])
        axes.set_xlim(-0.2, 1.2)
