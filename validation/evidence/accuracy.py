"""What accuracy costs on the seven blades: tables and picture of docs/accuracy.md, from the rows of contact_runs.

Errors are relative differences of rms of the leading edge's whole motion, in percent: at repeatable speeds, where no
perturbation changes much and no branch ends, and at steep places, the four steepest jumps of a blade's curve.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from published import INTERACTIONS, REFERENCE

from r37core.base.io import as_list
from r37core.figures import style
from r37core.rom.reduction_choice import MOST_USUAL_PATCHES, PATCHES, POINTS, USUAL_POINTS

from .configuration import settings_of
from .contact_runs import (
    ABOUT_PEAK,
    AS_SHIPPED,
    BARE,
    CENTRAL,
    DRAWN,
    EVERY_SPEED,
    FINEST,
    FINEST_STEP,
    FRICTION,
    FRICTION_BLADES,
    IN_PUBLISHED_RANGE,
    LINED,
    MATERIAL,
    MODES,
    MOST,
    PERTURBED,
    SCENES,
    SMALL,
    SPREAD,
    STANDARD,
    STEPS,
    STIFFER,
    TWICE_THE_BARS,
    USUAL,
    branch_speeds,
)
from .pages import write_table

SETTLED, JUMP, BESIDE = 0.03, 0.25, 5.0
"""Largest change of rms by a perturbation; change between speeds of GRID that counts as a jump; its surroundings (rad/s)."""

KINDS = [(BARE, POINTS), (BARE, PATCHES), (LINED, POINTS), (MATERIAL, PATCHES)]
NAMES = {BARE: "bare casing", LINED: "lining", MATERIAL: "lining"}
AS_USUAL = {POINTS: USUAL_POINTS, PATCHES: MOST_USUAL_PATCHES}
"""Numbers of contact nodes of the default."""

HEADS = [f"{NAMES[scene]}, {contact}" for scene, contact in KINDS]


@dataclass(frozen=True)
class Of:
    """Runs of all blades that differ in blade and speed alone."""

    scene: str
    contact: str
    what: str = AS_SHIPPED
    nodes: int = STANDARD
    count: int = USUAL
    modes: int = 10


class Runs:
    """The rows of all files."""

    def __init__(self, files: Iterable[str]):
        rows = pd.concat([pd.read_csv(file) for file in files], ignore_index=True).dropna(subset="scene")
        names = [field.name for field in fields(Of)]
        self._rows = {Of(*key): part.set_index(["blade", "speed"]).sort_index() for key, part in rows.groupby(names)}
        self.blades = list(settings_of(Path.cwd()).blades)
        self._places: dict[tuple[str, str, str], pd.Series] = {}

    def of(self, runs: Of, quantity: str = "rms") -> pd.Series:
        """A quantity of some runs by blade and speed (rad/s), empty if there are none."""
        return self._rows[runs][quantity] if runs in self._rows else _NONE

    def perturbation(self, scene: str, contact: str) -> pd.Series:
        """Largest relative change of rms by one of the perturbations, at all speeds that were perturbed."""
        base = self.of(Of(scene, contact))
        changes = [abs(self.of(Of(scene, contact, what)) / base - 1.0) for what in PERTURBED]
        return pd.concat(changes, axis=1).max(axis=1, skipna=False)

    def settled(self, scene: str, contact: str) -> pd.Series:
        """Whether the motion is settled, and no branch ends next to it."""
        changes = self.perturbation(scene, contact)
        return (changes < SETTLED) & ~self._near(changes.index, _jumps, BESIDE, Of(scene, contact, EVERY_SPEED))

    def steep(self, scene: str, contact: str) -> pd.Series:
        """Whether a speed is one of the steep places of its blade."""
        return self._near(self.of(Of(scene, contact)).index, branch_speeds, 0.1, Of(scene, contact, EVERY_SPEED))

    def _near(self, index: pd.MultiIndex, places: Callable[..., np.ndarray], distance: float, of: Of) -> pd.Series:
        """Whether speeds lie near the places of a curve of their blade."""
        near = pd.Series(False, index=index)
        for blade in index.get_level_values("blade").unique():
            speeds = near.loc[blade].index.to_numpy()
            near.loc[blade] = (abs(speeds[:, None] - places(*self.curve(of, blade))) < distance).any(axis=1)
        return near

    def curve(self, runs: Of, blade: str) -> tuple[np.ndarray, np.ndarray]:
        """Speeds (rad/s) and rms (m) of a blade."""
        curve = self.of(runs).loc[blade]
        return curve.index.to_numpy(), curve.to_numpy()

    def errors(self, ours: Of, theirs: Of, at: str = "settled", quantity: str = "rms") -> pd.Series:
        """Relative differences in percent at the repeatable speeds of SPREAD, or the steep ones, by blade and speed."""
        error = 100.0 * abs(self.of(ours, quantity) / self.of(theirs, quantity) - 1.0).dropna()
        return error[self._mask(ours.scene, ours.contact, at).reindex(error.index, fill_value=False)]

    def _mask(self, scene: str, contact: str, at: str) -> pd.Series:
        key = scene, contact, at
        if key not in self._places:
            mask = self.settled(scene, contact) if at == "settled" else self.steep(scene, contact)
            spread = mask.index.get_level_values("speed").isin(SPREAD)
            self._places[key] = mask & spread if at == "settled" else mask
        return self._places[key]


_NONE = pd.Series(dtype=float, index=pd.MultiIndex.from_arrays([[], []], names=["blade", "speed"]))


def _jumps(speeds: np.ndarray, rms: np.ndarray) -> np.ndarray:
    """Speeds (rad/s) on both sides of the jumps of a curve."""
    jump = abs(np.diff(rms)) > JUMP * np.minimum(rms[1:], rms[:-1])
    return np.concatenate([speeds[:-1][jump], speeds[1:][jump]])


def worst(errors: pd.Series) -> tuple[str, pd.Series]:
    """The blade with the largest mean, and its errors."""
    blade = errors.groupby("blade").mean().idxmax()
    return str(blade), errors.loc[blade]


def cell(errors: pd.Series) -> str:
    """Mean over all blades, then the worst blade with its mean; empty without errors."""
    if errors.empty:
        return ""
    blade, of_blade = worst(errors)
    return f"{_percent(errors.mean())}; {blade} {_percent(of_blade.mean())}"


@dataclass(frozen=True)
class Level:
    """A fidelity level: its mesh, and what its time integration is in CHANGES, in a bare casing and with a lining."""

    nodes: int
    bare: str
    lined: str

    def of(self, scene: str, contact: str) -> Of:
        """Its runs."""
        return Of(scene, contact, self.bare if scene == BARE else self.lined, self.nodes)


LEVELS = {
    "draft": Level(5000, "step 6.4e-06 s", AS_SHIPPED),
    "standard": Level(STANDARD, AS_SHIPPED, AS_SHIPPED),
    "paper": Level(STANDARD, CENTRAL, CENTRAL),
    "fine": Level(40000, "step 2.4e-06 s", "step 3.2e-06 s"),
}
MEASURED = [name for name in LEVELS if name != "paper"]
JUDGED = dict(zip(HEADS[::-1], KINDS[::-1], strict=True))


def levels(input: Any, output: Any, params: Any) -> None:
    """Levels: the price of each at repeatable speeds and in steep places, and its cost. Input: files of runs."""
    runs = Runs(as_list(input.files))
    known, rows = settings_of(Path.cwd()).levels, []
    for name, level in LEVELS.items():
        section, errors = known[name].time_integration, [""] * len(JUDGED)
        if name in MEASURED:
            errors = [_percent(worst(_of_level(runs, name, *kind))[1].mean()) for kind in JUDGED.values()]
        cost = (
            np.mean([runs.of(level.of(scene, POINTS), "cpu_s").median() for scene in SCENES[POINTS]])
            * section.revolutions
            / 200.0
        )
        rows.append([f"`{name}`", f"{level.nodes:,}", _step_of(section), *errors, f"{cost:.2f}"])
    write_table(["level", "nodes", "step (us)", *JUDGED, "CPU (s)"], rows, output.levels)
    steep = [[f"`{name}`", *(_steep_cell(runs, name, *kind) for kind in JUDGED.values())] for name in MEASURED]
    write_table(["level", *JUDGED], steep, output.steep)
    write_table(*_levels_of_blades(runs), output.blades)


def _step_of(section: Any) -> str:
    if section.time_step_s is not None:
        return f"{1e6 * section.time_step_s:g}"
    lined, bare = (1e6 * step for step in (section.largest_time_step_s.lined, section.largest_time_step_s.direct))
    return f"{lined:g}" if bare == lined else f"{lined:g}, {bare:g}"


def _steep_cell(runs: Runs, name: str, scene: str, contact: str) -> str:
    blade, errors = worst(_of_level(runs, name, scene, contact, "steep"))
    return f"{blade} {_percent(errors.median())}, {_percent(errors.max())}"


def _of_level(runs: Runs, name: str, scene: str, contact: str, at: str = "settled") -> pd.Series:
    return runs.errors(LEVELS[name].of(scene, contact), Of(scene, contact, nodes=FINEST), at)


def _levels_of_blades(runs: Runs) -> tuple[list[str], list[list[str]]]:
    rows = []
    for name in MEASURED:
        for scene, contact in KINDS:
            errors = _of_level(runs, name, scene, contact)
            cells = [_quantiles(errors[errors.index.get_level_values("blade") == blade]) for blade in runs.blades]
            rows.append([name, NAMES[scene], contact, *cells])
    return ["level", "scene", "contact", *(f"{blade}: mean, 90% quantile (%)" for blade in runs.blades)], rows


def _quantiles(errors: pd.Series) -> str:
    return "" if errors.empty else f"{errors.mean():.1f}, {errors.quantile(0.9):.1f}"


def _row(runs: Runs, name: str, against: str, pairs: Sequence[tuple[Of, Of]], quantity: str = "rms") -> list[str]:
    """A row of a table of errors; `pairs` in the order of KINDS."""
    return [name, against, *(cell(runs.errors(ours, theirs, quantity=quantity)) for ours, theirs in pairs)]


def _changed(ours: dict[str, Any], theirs: dict[str, Any]) -> list[tuple[Of, Of]]:
    return [(replace(Of(*kind), **ours), replace(Of(*kind), **theirs)) for kind in KINDS]


def convergence(input: Any, output: Any, params: Any) -> None:
    """Convergence in mesh and contact nodes; in modes, step, revolutions and bars; of stress. Input: files of runs."""
    runs = Runs(as_list(input.files))
    rows = [
        _row(runs, f"mesh of {nodes:,} nodes", f"{FINEST:,}", _changed({"nodes": nodes}, {"nodes": FINEST}))
        for nodes in (5000, SMALL, STANDARD, 40000)
    ]
    for count in (4, 8, 12, 15):
        pairs = _changed({"nodes": SMALL, "count": count}, {"nodes": SMALL, "count": MOST})
        pairs = [(replace(ours, count=USUAL) if count == AS_USUAL[ours.contact] else ours, theirs) for ours, theirs in pairs]
        rows.append(_row(runs, f"{count} along the tip", f"{MOST}", pairs))
    head = ["what", "against", *HEADS]
    write_table(head, rows, output.mesh)
    write_table(head, _motion_rows(runs), output.motion)
    stress = [("friction + 0.1%", AS_SHIPPED), (AS_SHIPPED, FINEST_STEP), (CENTRAL, FINEST_STEP)]
    pairs_of = [(what, against, _changed({"what": what}, {"what": against})) for what, against in stress]
    write_table(head, [_row(runs, what, against, pairs, "stress") for what, against, pairs in pairs_of], output.stress)


def _motion_rows(runs: Runs) -> list[list[str]]:
    finest = max(MODES)
    rows = [
        _row(
            runs,
            f"{modes} fixed-interface modes",
            f"{finest}",
            _changed({"nodes": SMALL, "modes": modes}, {"nodes": SMALL, "modes": finest}),
        )
        for modes in sorted({10, *MODES} - {finest})
    ]
    steps = [*(f"step {step:g} s" for step in STEPS if f"step {step:g} s" != FINEST_STEP), CENTRAL]
    compared = [
        *((what, FINEST_STEP) for what in steps),
        ("100 revolutions", AS_SHIPPED),
        (AS_SHIPPED, "400 revolutions"),
        ("friction + 0.1%", AS_SHIPPED),
        (TWICE_THE_BARS, AS_SHIPPED),
    ]
    return rows + [_row(runs, what, against, _changed({"what": what}, {"what": against})) for what, against in compared]


def chance(input: Any, output: Any, params: Any) -> None:
    """What chance decides: speeds that do not repeat, and how far a perturbation of 0.1% moves them. Input: files of runs."""
    runs, rows = Runs(as_list(input.files)), []
    for blade in runs.blades:
        rows.append([blade, *(_chance_cell(runs, blade, scene, contact) for scene, contact in KINDS)])
    write_table(["blade", *HEADS], rows, output.table)
    write_table(*_friction_table(runs), output.friction)


def _chance_cell(runs: Runs, blade: str, scene: str, contact: str) -> str:
    changes = runs.perturbation(scene, contact).loc[blade]
    changes = changes[changes.index.isin(SPREAD)]
    moved = 100.0 * changes[~(changes < SETTLED)]
    return f"{len(moved) / len(changes):.0%}" + (f": {moved.median():.0f}%, {moved.max():.0f}%" if len(moved) else "")


def _friction_table(runs: Runs) -> tuple[list[str], list[list[str]]]:
    rows = []
    for value in FRICTION:
        kind, cells = Of(BARE, PATCHES, f"friction {value:g}"), []
        for blade in FRICTION_BLADES:
            ours, half, central = (
                runs.of(replace(kind, what=kind.what + more)).loc[blade] for more in ("", ", half the step", f", {CENTRAL}")
            )
            calm = abs(half / ours - 1.0) < SETTLED
            error = 100.0 * abs(ours / central - 1.0)[calm]
            cells += [f"{calm.mean():.0%}", _percent(error.max()) if len(error.dropna()) else ""]
        rows.append([f"{value:g}", *cells])
    head = [f"{blade}: {what}" for blade in FRICTION_BLADES for what in ("repeatable speeds", "largest difference there")]
    return ["coefficient", *head], rows


def patches(input: Any, output: Any, params: Any) -> None:
    """Points and patches: each blade, the published direct contact, stiff linings, published peaks. Input: files of runs."""
    runs = Runs(as_list(input.files))
    write_table(*_blades_table(runs), output.blades)
    write_table(*_published_table(runs), output.published)
    write_table(*_stiffness_table(runs), output.stiffness)
    write_table(*_peaks_table(runs), output.peaks)


def _blades_table(runs: Runs) -> tuple[list[str], list[list[str]]]:
    rows = []
    change = runs.errors(Of(BARE, PATCHES), Of(BARE, POINTS))
    for blade in runs.blades:
        cells = []
        for contact in SCENES:
            speeds, rms = runs.curve(Of(BARE, contact, EVERY_SPEED), blade)
            top = int(np.nanargmax(rms))
            cells += [f"{1e3 * rms[top]:.2f} at {speeds[top]:g}", f"{speeds[np.nanargmin(np.diff(rms))]:g}"]
        rows.append([blade, *cells, f"{change.loc[blade].median():.1f}%"])
    head = [f"{contact}: {what}" for contact in SCENES for what in ("largest rms (mm)", "steepest jump (rad/s)")]
    return ["blade", *head, "change"], rows


PUBLISHED_CASES = {
    "8 points": Of(BARE, POINTS),
    f"8 points, {FINEST:,} nodes": Of(BARE, POINTS, nodes=FINEST),
    "12 patches": Of(BARE, PATCHES),
    f"12 patches, {FINEST:,} nodes": Of(BARE, PATCHES, nodes=FINEST),
    f"{MOST} even patches, {SMALL:,} nodes": Of(BARE, PATCHES, nodes=SMALL, count=MOST),
}


def _published_table(runs: Runs) -> tuple[list[str], list[list[str]]]:
    rows = []
    for name, of in PUBLISHED_CASES.items():
        curve = 1e3 * runs.of(replace(of, what=IN_PUBLISHED_RANGE), "normal").loc[REFERENCE]
        speeds, rms = curve.index.to_numpy(), curve.to_numpy()
        top, jump = int(np.argmax(rms)), int(np.argmin(np.diff(rms)))
        after = rms[jump + 1 : jump + 25].min()
        low = np.median(rms[speeds > speeds[jump] + 5.0])
        largest, jumped = [f"{rms[top]:.3f}", f"{speeds[top]:g}"], [f"{speeds[jump]:g}", f"{rms[jump]:.3f} to {after:.3f}"]
        rows.append([name, *largest, *jumped, f"{low:.3f}"])
    head = ["contact", "largest (mm)", "at (rad/s)", "jump after (rad/s)", "jump (mm)", "median above (mm)"]
    return head, rows


def _stiffness_table(runs: Runs) -> tuple[list[str], list[list[str]]]:
    """Medians of the mesh's error: lined branches are many there, and their ends move."""
    rows = []
    for times in (1, *STIFFER):
        what, cells = AS_SHIPPED if times == 1 else f"lining {times} times as stiff", []
        for contact, (_, lined) in SCENES.items():
            error = runs.errors(Of(lined, contact, what), Of(lined, contact, what, FINEST))
            cells += [_percent(error.median()), _percent(error.quantile(0.9))]
        rows.append([f"{times}", *cells])
    head = [f"{contact}: {what}" for contact in SCENES for what in ("median error of the mesh", "90% quantile")]
    return ["times as stiff", *head], rows


def _percent(value: float) -> str:
    return f"{value:.1f}%" if value < 10.0 else f"{value:.0f}%"


def _peaks_table(runs: Runs) -> tuple[list[str], list[list[str]]]:
    variants = {
        "published, on 8 points": Of(LINED, POINTS, EVERY_SPEED),
        "by its material, on 12 patches": Of(MATERIAL, PATCHES, EVERY_SPEED),
    }
    rows = []
    for name, of in variants.items():
        off = [100.0 * (_peak(*runs.curve(of, row.blade), row.peak) / row.peak - 1.0) for row in INTERACTIONS]
        rows.append([name, f"{np.mean(off):+.1f}%", f"{np.max(np.abs(off)):.1f}%"])
    return ["lining", "ten published peaks, mean difference", "largest"], rows


def _peak(speeds: np.ndarray, rms: np.ndarray, published: float) -> float:
    """Speed (rad/s) of the largest rms about a published peak."""
    low, high = (share * published for share in ABOUT_PEAK)
    near = (speeds >= low) & (speeds <= high)
    return float(speeds[near][np.nanargmax(rms[near])])


def draw(input: Any, output: Any, params: Any) -> None:
    """Direct contact of two blades on three meshes, on points and on patches. Input: files of runs."""
    runs = Runs(as_list(input.files))
    figure, panels = plt.subplots(len(DRAWN), 2, figsize=(style.PAGE, 4.2), sharex=True, sharey="row")
    for row, blade in zip(panels, DRAWN, strict=True):
        for axes, contact in zip(row, SCENES, strict=True):
            for nodes in (5000, STANDARD, FINEST):
                speeds, rms = runs.curve(Of(BARE, contact, EVERY_SPEED, nodes), blade)
                axes.plot(speeds, 1e3 * rms, label=f"{nodes:,} nodes")
            axes.set_title(f"{blade}, contact on {contact}")
        row[0].set_ylabel("rms of the leading edge (mm)")
    for axes in panels[-1]:
        axes.set_xlabel("angular speed (rad/s)")
    panels[0, 0].legend()
    style.save(figure, output.picture)
