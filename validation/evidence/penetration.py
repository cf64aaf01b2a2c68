"""Penetration of the tip's edge between contact nodes into a bare casing, by kind of nodes: cost, and limit in the mesh."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from r37core.base.io import atomic_write
from r37core.figures.style import PAGE, plt, save
from r37core.rom.reduction_choice import COSINE, EVEN, PATCHES, POINTS

from .configuration import settings_of
from .contact_runs import AS_SHIPPED, BARE, STANDARD, BladeRuns, Model
from .pages import write_table

EIGHT_EVEN, TWELVE, FIFTEEN = "8 even", "12 cosine", "15 cosine"
KINDS = {
    "8 points": Model(POINTS, 8, spacing=EVEN),
    EIGHT_EVEN: Model(PATCHES, 8, spacing=EVEN),
    "8 cosine": Model(PATCHES, 8, spacing=COSINE),
    TWELVE: Model(PATCHES, 12, spacing=COSINE),
    FIFTEEN: Model(PATCHES, 15, spacing=COSINE),
}
"""Contact nodes, all but the first patches, by their name in tables."""

SPEEDS = np.arange(750.0, 2000.5, 20.0)
"""(rad/s)"""

DRAWN = ("Ref", "S100")
AIM = 0.1
"""Share of the clearance."""

MESH_KINDS = (EIGHT_EVEN, TWELVE)
MESH_SPEEDS = np.arange(750.0, 2000.5, 40.0)
FINE = 40000
SETTLED = 0.02
PERTURBED = ("friction + 0.1%", "half the step")
"""Changes that leave the rms of a settled speed within SETTLED."""

COST_SPEEDS = {"Ref": 1330.0, "S100": 1835.0}
TURNS = 25


def _kinds(rows: pd.DataFrame) -> pd.Series:
    names = {(model.contact, model.count, model.spacing): name for name, model in KINDS.items()}
    return pd.Series(
        [names[key] for key in zip(rows["contact"], rows["count"], rows["spacing"], strict=True)], index=rows.index
    )


def read_runs(files: Any) -> pd.DataFrame:
    """Rows of files of BladeRuns with their `kind`, a name of KINDS; without those of models."""
    rows = pd.concat([pd.read_csv(file) for file in files], ignore_index=True).dropna(subset="scene")
    return rows.assign(kind=_kinds(rows))


def runs_of_blade(input: Any, output: Any, params: Any) -> None:
    """Runs of a blade at all SPEEDS on each of KINDS. Params: blade."""
    runs = BladeRuns(settings_of(Path.cwd()), params.blade, STANDARD)
    for model in KINDS.values():
        contact, _ = runs.model(model)
        runs.run(model, contact, BARE, SPEEDS, AS_SHIPPED)
    runs.write(output[0])


def penetration(input: Any, output: Any, params: Any) -> None:
    """Penetration of all blades at the worst speed of eight even patches, and the largest of all; rms there; curves of DRAWN.

    Input: files of runs_of_blade. Output: table, rms, picture.
    """
    rows = read_runs(input.files)
    clearance = settings_of(Path.cwd()).scenes[BARE].scene.casing.clearance
    depths, rms = [], []
    for blade, part in rows.groupby("blade", sort=False):
        curves = part.pivot(index="speed", columns="kind", values="penetration")[list(KINDS)]
        normal = part.pivot(index="speed", columns="kind", values="normal")[list(KINDS)]
        worst = curves[EIGHT_EVEN].idxmax()
        cells = [f"{1e6 * curves.loc[worst, kind]:.0f}; {1e6 * curves[kind].max():.0f}" for kind in KINDS]
        depths.append([blade, f"{worst:.0f}", *cells])
        rms.append([blade, f"{worst:.0f}", *(f"{1e3 * normal.loc[worst, kind]:.3f}" for kind in KINDS)])
    head = ["blade", f"worst speed of {EIGHT_EVEN} (rad/s)", *KINDS]
    write_table(head, depths, output.table)
    write_table(head, rms, output.rms)
    _draw(rows, clearance, output.picture)


def _draw(rows: pd.DataFrame, clearance: float, file: str) -> None:
    figure, panels = plt.subplots(1, len(DRAWN), figsize=(PAGE, 2.8), sharey=True)
    for axes, blade in zip(panels, DRAWN, strict=True):
        runs = rows[rows["blade"] == blade]
        for kind in KINDS:
            curve = runs[runs["kind"] == kind]
            axes.semilogy(curve["speed"], 1e6 * curve["penetration"], label=kind + " patches" * (kind != "8 points"))
        axes.axhline(1e6 * AIM * clearance, color="k", linestyle=":", label="a tenth of the clearance")
        axes.set_title(blade)
        axes.set_xlabel("speed (rad/s)")
    panels[0].set_ylabel("largest penetration of the edge (um)")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    save(figure, file)


def mesh_runs_of_blade(input: Any, output: Any, params: Any) -> None:
    """Runs of a blade at MESH_SPEEDS on two meshes with the same step, as shipped and perturbed. Params: blade."""
    settings, rows = settings_of(Path.cwd()), []
    for nodes in (STANDARD, FINE):
        runs = BladeRuns(settings, params.blade, nodes)
        for kind in MESH_KINDS:
            contact, _ = runs.model(KINDS[kind])
            for what in (AS_SHIPPED, *PERTURBED):
                runs.run(KINDS[kind], contact, BARE, MESH_SPEEDS, what)
        rows += runs.rows
    with atomic_write(output[0]) as new:
        pd.DataFrame(rows).to_csv(new, index=False, float_format="%.8g")


def mesh_limit(input: Any, output: Any, params: Any) -> None:
    """Differences of normal and tangential rms between two meshes at repeatable speeds, or all where a blade has none.

    Input: files of mesh_runs_of_blade. Output: table.
    """
    rows = read_runs(input.files)
    table = []
    for (blade, kind), part in rows.groupby(["blade", "kind"], sort=False):
        runs = {key: run.set_index("speed")[["normal", "tangential"]] for key, run in part.groupby(["nodes", "what"])}
        base = {nodes: runs[nodes, AS_SHIPPED] for nodes in (STANDARD, FINE)}
        changes = [abs(runs[nodes, what] / base[nodes] - 1.0) for nodes in base for what in PERTURBED]
        settled = np.all([(change < SETTLED).all(axis=1) for change in changes], axis=0)
        error = 100.0 * abs(base[STANDARD] / base[FINE] - 1.0)
        chosen = error[settled] if settled.any() else error
        cells = [f"{chosen[name].median():.1f}%; {chosen[name].max():.1f}%" for name in ("normal", "tangential")]
        friction = 100.0 * abs(runs[STANDARD, PERTURBED[0]] / base[STANDARD] - 1.0)
        cells += [", ".join(f"{change[name].median():.1f}%" for name in change) for change in (error, friction)]
        table.append([blade, kind, f"{settled.sum()} of {len(settled)}", *cells])
    head = ["blade", "patches", "repeatable speeds", "normal rms: median; largest", "tangential rms: median; largest"]
    write_table([*head, "all speeds: medians", f"{PERTURBED[0]}: medians"], table, output.table)


def cost(input: Any, output: Any, params: Any) -> None:
    """CPU time of a run on patches, least of TURNS in turns, and its ratio to eight even ones. Output: table."""
    settings, table = settings_of(Path.cwd()), []
    kinds = [kind for kind, model in KINDS.items() if model.contact == PATCHES]
    for blade, speed in COST_SPEEDS.items():
        runs = BladeRuns(settings, blade, STANDARD)
        contacts = {kind: runs.model(KINDS[kind])[0] for kind in kinds}
        for _ in range(TURNS):
            for kind, contact in contacts.items():
                runs.run(KINDS[kind], contact, BARE, [speed], AS_SHIPPED)
        rows = pd.DataFrame(runs.rows).dropna(subset="scene")
        least = rows.assign(kind=_kinds(rows)).groupby("kind")["cpu_s"].min()
        cells = [f"{1e3 * least[kind]:.0f} ({least[kind] / least[EIGHT_EVEN]:.2f})" for kind in kinds]
        table.append([f"{blade}, {speed:.0f} rad/s", *cells])
    write_table(["run", *(f"{kind}: CPU (ms)" for kind in kinds)], table, output.table)
