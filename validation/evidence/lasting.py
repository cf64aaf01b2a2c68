"""How long interactions on the lining last, and the thickness that suffices for each: the reference blade on points."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from published import INTERACTIONS, REFERENCE

from r37core.base.io import atomic_write
from r37core.config import Settings
from r37core.contact.scene import Scene
from r37core.figures.style import PAGE, plt, save
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.stress.operator import StressOperator
from r37core.stress.statistic import stress_statistic
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.speed_run import run_speed

from .configuration import settings_of
from .contact_runs import ABOUT_PEAK, LINED
from .pages import write_table
from .which_blade import Models

SPEEDS = np.arange(1660.0, 1770.1, 2.0)
"""(rad/s) About 1B/4."""

LENGTHS, UNTIL_SETTLED, MOST = (200, 1000, 5000), "until settled", 5000
"""Revolutions of runs, and the most until settled."""

RISE = 40.0
"""Revolutions in which the lobes rise, whatever the length of a run: the published share of 200."""

STATISTIC = 100
"""Last revolutions whose stress counts, whatever the length of a run."""

STEP, FACTOR, BESIDE = 4.0, 20.0, 0.01
"""Step of speeds about a peak (rad/s); thickness that no run wears through, over the shipped one; share beside a found one."""


@dataclass(frozen=True)
class Length:
    """Length of a run: its name, revolutions, and whether it ends when settled."""

    name: str
    revolutions: int
    until_settled: bool = False


RUNS = (*(Length(f"{number:,}", number) for number in LENGTHS), Length(UNTIL_SETTLED, MOST, until_settled=True))
THICKNESS_RUNS = (RUNS[0], RUNS[-1])


def _run(
    settings: Settings, contact: ContactModel, scene: Scene, speed: float, length: Length, stress: StressOperator | None = None
) -> dict[str, Any]:
    shipped = settings.integration_choice(REFERENCE, LINED, speed)
    snapshots = 0 if stress is None else STATISTIC
    choice = replace(
        shipped, revolutions=length.revolutions, until_settled=length.until_settled, snapshot_revolutions=snapshots
    )
    results = ("wear",) if stress is None else ("stress", "wear")
    return run_speed(
        contact, speed, scene, choice, results, spectrum_highest_order=1, wear_angles=8, stress=stress and {"judged": stress}
    )


def runs(input: Any, output: Any, params: Any) -> None:
    """Runs of all RUNS at SPEEDS. Input: contact, stress, of the reference blade on points."""
    settings, models = settings_of(Path.cwd()), Models.read(input.contact, input.stress)
    shipped, limit = settings.scenes[LINED].scene, settings.blades[REFERENCE].material.yield_stress
    scene, rows = replace(shipped, casing=replace(shipped.casing, rise_revolutions=RISE)), []
    for speed in map(float, SPEEDS):
        for length in RUNS:
            run = _run(settings, models.contact, scene, speed, length, models.stress)
            last = stress_statistic(run["revolution_von_mises"][0, -STATISTIC:], limit)
            rows.append(
                {
                    "speed": speed,
                    "length": length.name,
                    "revolutions": int(run["statistic_end"]),
                    "motion_at_end": MotionAtEnd(int(run["motion_at_end"])).text,
                    "rms": float(np.hypot(*run["rms"][0, [0, 2]])),
                    "above": bool(last["share_of_revolutions_above_yield"] > 0.5),
                    "worn_through": bool(run["worn_through_share"] > 0.0),
                }
            )
    with atomic_write(output[0]) as new:
        pd.DataFrame(rows).to_csv(new, index=False, float_format="%.8g")


def lasting(input: Any, output: Any, params: Any) -> None:
    """Table by length of a run, and curves of rms. Input: the file of runs. Output: table, picture."""
    rows = pd.read_csv(input.runs)
    table = []
    for length, part in rows.groupby("length", sort=False):
        name = length
        if length == UNTIL_SETTLED:
            name = f"{length}: {part['revolutions'].min():,} to {part['revolutions'].max():,}"
        states = part["motion_at_end"].value_counts()
        counts = [states.get(state.text, 0) for state in (MotionAtEnd.LASTING, MotionAtEnd.GROWING, MotionAtEnd.CUT_FREE)]
        table.append([name, _range(part[part["above"]]["speed"]), *map(str, [*counts, part["worn_through"].sum()])])
    head = ["revolutions", "above yield (rad/s)", "lasting", "growing", "cut free", "worn through"]
    write_table(head, table, output.table)
    _draw(rows, output.picture)


def _range(speeds: pd.Series) -> str:
    return "none" if speeds.empty else f"{speeds.min():.0f} to {speeds.max():.0f}"


def _draw(rows: pd.DataFrame, file: str) -> None:
    figure, axes = plt.subplots(figsize=(PAGE, 2.8))
    for (length, part), style in zip(rows[rows["length"] != UNTIL_SETTLED].groupby("length", sort=False), "oxv", strict=True):
        axes.plot(part["speed"], 1e3 * part["rms"], f"{style}-", markersize=3, label=f"{length} revolutions")
    axes.set_xlabel("speed (rad/s)")
    axes.set_ylabel("rms of the leading edge (mm)")
    axes.legend()
    save(figure, file)


def thicker(scene: Scene, thickness: float) -> Scene:
    """The scene with another thickness (m) of the lining, and with bars of the same stiffness."""
    lining = scene.lining
    assert lining is not None
    factor = thickness / lining.thickness
    moduli = {name: factor * getattr(lining, name) for name in ("elastic_modulus", "plastic_modulus")}
    return replace(scene, lining=replace(lining, thickness=thickness, **moduli))


def thickness_runs(input: Any, output: Any, params: Any) -> None:
    """Runs about the peaks of the reference blade in the shipped thickness, and in FACTOR times as much. Input: contact."""
    settings, contact = settings_of(Path.cwd()), read_contact_model(input.contact)
    scene, rows = settings.scenes[LINED].scene, []
    assert scene.lining is not None
    shipped = scene.lining.thickness

    def run(order: int, speed: float, length: Length, thickness: float, kind: str) -> dict[str, Any]:
        numbers = _run(settings, contact, thicker(scene, thickness), speed, length)
        found = {"used": float(numbers["used_thickness"]), "through": bool(numbers["worn_through_share"] > 0.0)}
        row = {"order": order, "speed": speed, "length": length.name, "kind": kind, "thickness": thickness, **found}
        rows.append(row)
        return row

    for order, peak in ((row.engine_order, row.peak) for row in INTERACTIONS if row.blade == REFERENCE):
        speeds = np.arange(*(round(share * peak) for share in ABOUT_PEAK), STEP)
        for length in THICKNESS_RUNS:
            for speed in map(float, speeds):
                run(order, speed, length, shipped, "shipped")
            used = [run(order, float(speed), length, FACTOR * shipped, "thick") for speed in speeds]
            worst = max(used, key=lambda row: row["used"])
            for kind, share in {"less": 1.0 - BESIDE, "more": 1.0 + BESIDE}.items():
                run(order, worst["speed"], length, share * worst["used"], kind)
    with atomic_write(output[0]) as new:
        pd.DataFrame(rows).to_csv(new, index=False, float_format="%.8g")


def sufficient_thickness(input: Any, output: Any, params: Any) -> None:
    """Thickness that suffices at all speeds about each interaction. Input: the file of thickness_runs. Output: table."""
    table = []
    for order, interaction in pd.read_csv(input.runs).groupby("order", sort=False):
        cells = []
        for _, part in interaction.groupby("length", sort=False):
            kinds = {kind: rows.set_index("speed") for kind, rows in part.groupby("kind")}
            used, shipped = kinds["thick"]["used"], kinds["shipped"]["through"]
            # with a hundredth less it is worn through, with a hundredth more it is not
            holds = bool(kinds["less"]["through"].iloc[0]) and not bool(kinds["more"]["through"].iloc[0])
            found = f"{1e3 * used.max():.1f} ({used.idxmax():.0f})" + ("" if holds else ", not confirmed")
            cells += [f"{shipped.sum()}/{len(shipped)}", found]
        table.append([f"1B/{order}", *cells])
    head = ["interaction"]
    for length in THICKNESS_RUNS:
        head += [f"{length.name}: worn through", f"{length.name}: mm (rad/s)"]
    write_table(head, table, output.table)
