"""The lining by its material: its limit in bars, step, contact nodes and mesh, and what the contact length does."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from published import INTERACTIONS

from r37core.config import Settings
from r37core.contact.scene import Scene
from r37core.fem.matrices import assemble
from r37core.figures.style import plt, save
from r37core.mesh.blade_mesh import BladeMesh
from r37core.mesh.generate import generate_mesh
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import EVEN, PATCHES, POINTS
from r37core.stress.recovery import stress_operator
from r37core.stress.statistic import stress_statistic
from r37core.time_integration.speed_run import run_speed

from .configuration import settings_of
from .contact_runs import TIP_ELEMENTS, with_friction
from .pages import write_table
from .paper_box import BOX
from .which_blade import Models, length_of_runs

MATERIAL = "material_abradable"
BELOW, ABOVE, STEP = 0.03, 0.13, 6.0
"""Speeds about a blade's published peak of 1B/4, as shares of it, and their step (rad/s)."""

CONTACT_LENGTHS = (0.5e-4, 1e-4, 1.585e-4, 2.5e-4, 5e-4, 1e-3)
"""(m) From a third of the published model's to a tip's thickness."""

SPEEDS = np.arange(750.0, 2001.0, 10.0)
"""(rad/s) Of the length above yield at a contact length."""

_DIFFERENCES = ("rms: median error", "speeds on another branch")
_KEPT = {"spectrum_highest_order": 1, "wear_angles": 500}

COUNTS, USUAL = (4, 8, 12, 15, 29), 12
"""Numbers of patches, and the default."""

OTHER_BRANCH = 0.25
"""Relative difference of the rms at a speed that counts as another branch of the motion."""

OWN_CHORD, TIP_CHORD = 0.2, 0.056
"""Chord (m) of a blade of one's own, and of rotor 37's tip."""


@dataclass(frozen=True)
class Range:
    """What is compared of runs about an interaction: `begin` and `end` (rad/s) above yield, `rms` (m) and `wear` (m).

    `rms`: of the leading edge's tangential motion at each speed, shape (speeds,); `wear`: profile round the casing, shape
    (speeds, angles); `first`, `last`: places of the range among the speeds.
    """

    begin: float
    end: float
    rms: np.ndarray
    wear: np.ndarray
    first: int
    last: int


def peak_of(blade: str) -> float:
    """Published peak (rad/s) of 1B/4."""
    return next(row.peak for row in INTERACTIONS if row.blade == blade and row.engine_order == 4)


def interaction_range(settings: Settings, models: Models, scene: Scene, speeds: np.ndarray, step: float | None = None) -> Range:
    """Range of a scene over the `speeds` (rad/s); `step` (s) in place of the level's."""
    above, rms, wear = [], [], []
    for speed in map(float, speeds):
        choice = settings.integration_choice("Ref", MATERIAL, speed)
        choice = choice if step is None else replace(choice, time_step=step)
        run = run_speed(models.contact, speed, scene, choice, ("stress", "wear"), stress={"judged": models.stress}, **_KEPT)
        limit = settings.blades["Ref"].material.yield_stress
        share = stress_statistic(run["revolution_von_mises"][0], limit)["share_of_revolutions_above_yield"]
        above.append(float(share) > 0.5)
        rms.append(float(run["rms"][0, 2]))
        wear.append(run["wear"])
    first, last = (int(np.flatnonzero(above)[end]) for end in (0, -1)) if any(above) else (0, 0)
    return Range(float(speeds[first]), float(speeds[last]), np.array(rms), np.array(wear), first, last)


def models_on(mesh: BladeMesh, settings: Settings, blade: str, contact: str, count: int) -> Models:
    """Models of a mesh with a number of contact nodes; the most patches are evenly spaced, as closer ones do not fit."""
    material, spacing = settings.blades[blade].material, EVEN if count == max(COUNTS) else None
    boundary = replace(settings.boundary_choice(blade), contact=contact, nodes=count, spacing=spacing)
    reduction, regions = settings.reduction_choice(blade), settings.stress_regions(blade)
    reduced = reduce_blade(mesh, assemble(mesh, material), material, boundary, reduction, regions)
    return Models(contact_model(reduced, boundary.tip_line), stress_operator(reduced, material))


def mesh_of(settings: Settings, blade: str, nodes: int) -> BladeMesh:
    """Mesh of a blade."""
    return generate_mesh(settings.blades[blade].definition.build(round_edges=True), nodes, 1, TIP_ELEMENTS[nodes])


def limits_of_blade(input: Any, output: Any, params: Any) -> None:
    """Ranges of a blade with other bars, steps and contact nodes. Params: blade."""
    settings = settings_of(Path.cwd(), scenes=[MATERIAL])
    mesh, scene, peak = mesh_of(settings, params.blade, 20000), settings.scenes[MATERIAL].scene, peak_of(params.blade)
    speeds = np.arange(round((1.0 - BELOW) * peak), (1.0 + ABOVE) * peak, STEP)
    models = {count: models_on(mesh, settings, params.blade, PATCHES, count) for count in COUNTS}

    def bars(number: int) -> Scene:
        assert scene.lining is not None
        return replace(scene, lining=replace(scene.lining, bars=number))

    finest = interaction_range(settings, models[15], bars(40_000), speeds, 8e-7)
    cases: dict[str, tuple[Models, Scene, float | None]] = {
        **{f"{number:,} bars": (models[USUAL], bars(number), None) for number in (2500, 10_000, 40_000)},
        **{f"step {step:.1e} s": (models[USUAL], scene, step) for step in (3.2e-6, 1.6e-6, 8e-7)},
        **{f"{count} patches": (models[count], scene, None) for count in COUNTS if count != USUAL},
        **{f"friction {share:+.1%}": (models[USUAL], with_friction(scene, 1.0 + share), None) for share in (-0.001, 0.001)},
    }
    rows = [
        _row(params.blade, name, interaction_range(settings, model, lined, speeds, step), finest)
        for name, (model, lined, step) in cases.items()
    ]
    rows.append(_row(params.blade, "15 patches, 40,000 bars, 8.0e-07 s", finest, finest))
    pd.DataFrame(rows).to_csv(output[0], index=False)


def _row(blade: str, case: str, found: Range, finest: Range) -> dict[str, Any]:
    inside = inside_of(finest)
    wear = np.abs(found.wear - finest.wear).mean(axis=1) / np.maximum(finest.wear.max(axis=1), 1e-12)
    return {
        "blade": blade,
        "case": case,
        "begin": found.begin,
        "end": found.end,
        **differences(found, finest),
        "wear": 100.0 * np.median(wear[inside]),
    }


def inside_of(finest: Range) -> slice:
    """Places of the speeds of a range but its last, where a branch ends."""
    return slice(finest.first, max(finest.last, finest.first + 1))


def differences(found: Range, finest: Range) -> dict[str, float]:
    """Median difference of the rms (%) over the speeds of the finest's range; how many of them are on another branch."""
    inside = inside_of(finest)
    change = np.abs(found.rms[inside] / finest.rms[inside] - 1.0)
    return {"rms": 100.0 * np.median(change), "other_branch": np.sum(change > OTHER_BRANCH), "speeds": len(change)}


def own_blade(input: Any, output: Any, params: Any) -> None:
    """The same of a blade with a chord of 200 mm, on points and patches of its own meshes. Output: table."""
    settings, scale = settings_of(Path.cwd(), scenes=[MATERIAL]), OWN_CHORD / TIP_CHORD
    shipped = settings.scenes[MATERIAL].scene
    casing = replace(shipped.casing, clearance=1e-3, height=2e-3)
    scene, peak = replace(shipped, casing=casing), peak_of("Ref") / scale
    box = settings.stress_regions("Ref")[BOX]
    bounds = {name: scale * getattr(box, name) for name in ("maximum_x", "minimum_z", "maximum_z")}
    speeds, ranges = np.arange((1.0 - BELOW) * peak, (1.0 + ABOVE) * peak, STEP / scale), {}
    for nodes in (10_000, 20_000, 40_000):
        mesh = mesh_of(settings, "Ref", nodes)
        mesh = replace(mesh, points=scale * mesh.points)
        for contact, count in ((POINTS, 8), (PATCHES, 8), (PATCHES, USUAL)):
            models = models_scaled(mesh, settings, contact, count, bounds)
            ranges[f"{count} {contact}", nodes] = interaction_range(settings, models, scene, speeds, scale * 6.4e-6)
    finest = ranges[f"{USUAL} patches", 40_000]
    rows = [
        [name, f"{nodes:,}", f"{found.begin:.1f} to {found.end:.1f}", *_cells(differences(found, finest))]
        for (name, nodes), found in ranges.items()
    ]
    write_table(["contact", "nodes of the mesh", "above yield (rad/s)", *_DIFFERENCES], rows, output.table)


def models_scaled(mesh: BladeMesh, settings: Settings, contact: str, count: int, bounds: dict[str, float]) -> Models:
    """Models of a mesh with another region of the stress."""
    material, reduction = settings.blades["Ref"].material, settings.reduction_choice("Ref")
    boundary = replace(settings.boundary_choice("Ref"), contact=contact, nodes=count)
    regions = {BOX: replace(settings.stress_regions("Ref")[BOX], **bounds)}
    reduced = reduce_blade(mesh, assemble(mesh, material), material, boundary, reduction, regions)
    return Models(contact_model(reduced, boundary.tip_line), stress_operator(reduced, material))


def _cells(of: dict[str, float]) -> list[str]:
    return [f"{of['rms']:.1f}%", f"{of['other_branch']}/{of['speeds']}"]


def limits(input: Any, output: Any, params: Any) -> None:
    """Table of all blades: range above yield, error of the rms, speeds on another branch, error of the wear profile.

    Input: files of limits_of_blade.
    """
    found = pd.concat([pd.read_csv(file) for file in input.files])
    blades, rows = list(dict.fromkeys(found.blade)), []
    for case, of_case in found.groupby("case", sort=False):
        cells = [
            "; ".join([f"{row.begin:.0f} to {row.end:.0f}", *_cells(row._asdict()), f"{row.wear:.1f}%"])
            for row in of_case.set_index("blade").loc[blades].itertuples()
        ]
        rows.append([case, *cells])
    write_table(["case", *blades], rows, output.table)


def contact_lengths_of_blade(input: Any, output: Any, params: Any) -> None:
    """Length above yield of a blade at each of CONTACT_LENGTHS. Input: contact, stress. Params: blade."""
    settings, models = settings_of(Path.cwd(), scenes=[MATERIAL]), Models.read(input.contact, input.stress)
    scene = settings.scenes[MATERIAL].scene
    assert scene.lining is not None
    row: dict[str, float | str] = {"blade": params.blade}
    for length in CONTACT_LENGTHS:
        other = replace(scene, lining=replace(scene.lining, contact_length=length))
        row[f"{1e3 * length:.3g}"] = length_of_runs(settings, models, params.blade, other, SPEEDS)
    pd.DataFrame([row]).to_csv(output[0], index=False)


def spread(heights: Mapping[str, float], least: float) -> dict[str, float]:
    """Heights of labels, in the order of those of their curves, at `least` so far apart."""
    places: dict[str, float] = {}
    for name, height in sorted(heights.items(), key=lambda each: each[1]):
        places[name] = max(height, max(places.values(), default=-np.inf) + least)
    return places


def contact_lengths(input: Any, output: Any, params: Any) -> None:
    """Lengths and places of all blades at each contact length, and their picture. Input: files of contact_lengths_of_blade."""
    table = pd.concat([pd.read_csv(file) for file in input.files]).set_index("blade")
    ranks = table.rank(method="min").astype(int)
    rows = [[blade, *(f"{table.loc[blade, name]:.0f} ({ranks.loc[blade, name]})" for name in table)] for blade in table.index]
    write_table(["blade", *(f"{name} mm" for name in table)], rows, output.table)
    figure, axes = plt.subplots(figsize=(5.2, 3.2))
    heights = spread(table.iloc[:, -1].to_dict(), 0.075 * float(table.to_numpy().max()))
    for blade in table.index:
        (line,) = axes.semilogx(table.columns.astype(float), table.loc[blade], "o-", markersize=4)
        axes.annotate(str(blade), (1.1, heights[blade]), color=line.get_color(), va="center", annotation_clip=False, fontsize=9)
    axes.set(xlabel="contact length (mm)", ylabel="speeds above yield (rad/s)")
    axes.set_xticks(table.columns.astype(float), list(table.columns))
    axes.minorticks_off()
    save(figure, output.picture)
