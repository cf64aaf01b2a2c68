"""Runs of the seven blades from which the tables of accuracy are made: on several meshes, with one thing changed at a time.

A file has one row for each run: what was run, rms of the leading edge's whole motion (m), largest stress (Pa), CPU time (s),
largest penetration of the tip's edge (m).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from published import REFERENCE

from r37core.base.io import atomic_write
from r37core.config import Settings
from r37core.contact.scene import Scene
from r37core.fem.matrices import assemble
from r37core.mesh.generate import generate_mesh
from r37core.rom.contact_model import ContactModel
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import EVEN, PATCHES, POINTS
from r37core.stress.operator import StressOperator
from r37core.stress.recovery import stress_operator
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.problem import UnstableStepError
from r37core.time_integration.speed_run import run_speed

from .configuration import settings_of

BARE, LINED, MATERIAL = "direct", "abradable", "material_abradable"
SCENES = {POINTS: (BARE, LINED), PATCHES: (BARE, MATERIAL)}
"""Scenes by what contact acts on: the published lining needs the published points."""

TIP_ELEMENTS = {5000: 21, 10000: 28, 20000: 42, 40000: 56, 60000: 70}
"""Nodes of a mesh, and its elements along the tip: those of the levels, one mesh between, and a finer one."""

STANDARD, SMALL, FINEST = 20000, 10000, 60000
USUAL, MOST = 0, 29
"""Numbers of contact nodes: the default's (of a coarse mesh fewer patches), and the most that fit the small mesh."""

COUNTS, MODES = {POINTS: (4, 15, MOST), PATCHES: (4, 8, MOST)}, (3, 40)
"""Contact nodes and fixed-interface modes that are tried on the small mesh, next to the default's."""

GRID = np.arange(750.0, 2000.5, 5.0)
SPREAD = np.arange(750.0, 2000.5, 25.0)
FEW = SPREAD[2::4]
"""Speeds (rad/s): where branches are looked for, where errors are averaged, where runs are expensive."""

PUBLISHED_RANGE = np.arange(1250.0, 1400.5)
"""Speeds (rad/s) about the published jump of the reference blade in direct contact."""

BRANCHES, BELOW = 4, 5.0
"""Steepest jumps of a curve that are looked at; how far (rad/s) below its top a branch is run, too."""

ABOUT_PEAK = (0.97, 1.06)
DRAWN = ("L100", "S50")
"""Blades whose curves are drawn on three meshes."""

STRESS_REVOLUTIONS = 20
_KEPT = {"spectrum_highest_order": 1, "wear_angles": 8}

AS_SHIPPED, EVERY_SPEED, IN_PUBLISHED_RANGE = "as shipped", "every speed", "published range"
PERTURBED = ("friction + 0.1%", "friction - 0.1%", "half the step")
CENTRAL = "central differences, 1e-07 s"
FINEST_STEP = "step 8e-07 s"
TWICE_THE_BARS = "twice as many bars"
STEPS = (6.4e-6, 3.2e-6, 8e-7)
STIFFER = (10, 100)
FRICTION = (0.2, 0.25, 0.3, 0.5)
FRICTION_BLADES = ("Ref", "CS50")


@dataclass(frozen=True)
class Model:
    """What contact acts on: kind, number along the tip, fixed-interface modes of the reduced model, and spacing.

    A spacing of None is the default's.
    """

    contact: str
    count: int = USUAL
    modes: int = 10
    spacing: str | None = None


@dataclass(frozen=True)
class Run:
    """Scene and time integration of a run."""

    scene: Scene
    choice: IntegrationChoice


Change = Callable[[Run], Run]


def _choice(**changes: Any) -> Change:
    return lambda run: replace(run, choice=replace(run.choice, **changes))


def with_friction(scene: Scene, share: float, value: float | None = None) -> Scene:
    """A scene with a share of its coefficient of friction, or of another value."""
    coefficient = scene.friction.coefficient if value is None else value
    return replace(scene, friction=replace(scene.friction, coefficient=share * coefficient))


def _friction(share: float, value: float | None = None) -> Change:
    return lambda run: replace(run, scene=with_friction(run.scene, share, value))


def _half_the_step(run: Run) -> Run:
    return replace(run, choice=replace(run.choice, time_step=0.5 * run.choice.time_step))


def _lining(**factors: int) -> Change:
    def change(run: Run) -> Run:
        lining = run.scene.lining
        values = {name: factor * getattr(lining, name) for name, factor in factors.items()}
        return replace(run, scene=replace(run.scene, lining=replace(lining, **values)))

    return change


def _both(*changes: Change) -> Change:
    def change(run: Run) -> Run:
        for each in changes:
            run = each(run)
        return run

    return change


_CENTRAL_STEP = _choice(time_step=1e-7, integrator=CENTRAL_DIFFERENCE)
CHANGES: dict[str, Change] = {
    **{what: lambda run: run for what in (AS_SHIPPED, EVERY_SPEED, IN_PUBLISHED_RANGE)},
    "friction + 0.1%": _friction(1.001),
    "friction - 0.1%": _friction(0.999),
    "half the step": _half_the_step,
    **{f"step {step:g} s": _choice(time_step=step, integrator=EXACT_MODAL) for step in (*STEPS, 2.4e-6)},
    CENTRAL: _CENTRAL_STEP,
    "100 revolutions": _choice(revolutions=100),
    "400 revolutions": _choice(revolutions=400),
    TWICE_THE_BARS: _lining(bars=2),
    **{f"lining {times} times as stiff": _lining(elastic_modulus=times, plastic_modulus=times) for times in STIFFER},
    **{f"friction {value:g}": _friction(1.0, value) for value in FRICTION},
    **{f"friction {value:g}, half the step": _both(_friction(1.0, value), _half_the_step) for value in FRICTION},
    **{f"friction {value:g}, {CENTRAL}": _both(_friction(1.0, value), _CENTRAL_STEP) for value in FRICTION},
}
"""What is changed -> the run with it, from one as shipped."""


class BladeRuns:
    """Runs of one blade, which add up to the rows of a file."""

    def __init__(self, settings: Settings, blade: str, nodes: int):
        self._settings, self._blade, self._nodes = settings, blade, nodes
        chosen = settings.blades[blade]
        self._material = chosen.material
        self._mesh = generate_mesh(chosen.definition.build(round_edges=True), nodes, 1, TIP_ELEMENTS[nodes])
        self._matrices = assemble(self._mesh, chosen.material)
        self.rows: list[dict[str, Any]] = []

    def model(self, model: Model) -> tuple[ContactModel, StressOperator]:
        """The contact model on this mesh, and its stress."""
        settings, blade = self._settings, self._blade
        nodes = {"contact": model.contact, "nodes": model.count or None, "spacing": model.spacing}
        boundary = replace(settings.boundary_choice(blade), **nodes)
        reduction = replace(settings.reduction_choice(blade), fixed_interface_modes=model.modes)
        regions = settings.stress_regions(blade)
        begun = time.process_time()
        reduced = reduce_blade(self._mesh, self._matrices, self._material, boundary, reduction, regions)
        spent = time.process_time() - begun
        self.rows.append(self._row(model, what="the model", cpu_s=spent))
        return contact_model(reduced, boundary.tip_line), stress_operator(reduced, self._material)

    def _row(self, model: Model, **numbers: Any) -> dict[str, Any]:
        words = {"contact": model.contact, "count": model.count, "modes": model.modes, "spacing": model.spacing}
        return {"blade": self._blade, "nodes": self._nodes, **words, **numbers}

    def run(
        self,
        model: Model,
        contact: ContactModel,
        scene: str,
        speeds: Iterable[float],
        what: str,
        stress: StressOperator | None = None,
        change: Change | None = None,
    ) -> np.ndarray:
        """rms (m) at the speeds (rad/s) with a change of CHANGES, or another one; NaN where the run diverged or is refused."""
        found = []
        for speed in speeds:
            choice = replace(self._settings.integration_choice(self._blade, scene, speed), snapshot_revolutions=0)
            run = (change or CHANGES[what])(Run(self._settings.scenes[scene].scene, choice))
            numbers = _numbers(contact, float(speed), run, stress)
            self.rows.append(self._row(model, scene=scene, what=what, speed=float(speed), **numbers))
            found.append(numbers["rms"])
        return np.array(found)

    def write(self, file: Path | str) -> None:
        """Write all rows."""
        with atomic_write(file) as new:
            pd.DataFrame(self.rows).to_csv(new, index=False, float_format="%.8g")


def _numbers(contact: ContactModel, speed: float, run: Run, stress: StressOperator | None) -> dict[str, float]:
    results, choice = ((), run.choice) if stress is None else (("stress",), _with_snapshots(run.choice))
    begun = time.process_time()
    try:
        numbers = run_speed(contact, speed, run.scene, choice, results, **_KEPT, stress=stress and {"judged": stress})
    except UnstableStepError:
        return {"rms": np.nan}
    spent = time.process_time() - begun
    rms = np.hypot(*numbers["rms"][0, [0, 2]]) if numbers["status"] == 0 else np.nan
    largest = np.nan if stress is None else np.median(numbers["revolution_von_mises"][0])
    shared = {
        "step_s": float(numbers["time_step"]),
        "in_contact": float(numbers["share_of_time_in_contact"]),
        "penetration": float(numbers["largest_penetration"]),
    }
    normal, tangential = numbers["rms"][0, [0, 2]]
    return {"rms": rms, "normal": normal, "tangential": tangential, "stress": largest, "cpu_s": spent, **shared}


def _with_snapshots(choice: IntegrationChoice) -> IntegrationChoice:
    return replace(choice, snapshot_revolutions=STRESS_REVOLUTIONS)


def branch_speeds(speeds: np.ndarray, rms: np.ndarray) -> np.ndarray:
    """Steep places of a curve: the last speeds before its steepest jumps down, and BELOW each."""
    lost = np.nan_to_num(rms[:-1] - rms[1:])
    tops = speeds[:-1][np.argsort(lost)[::-1][:BRANCHES]]
    return np.unique(np.concatenate([tops, tops - BELOW]).clip(speeds[0], speeds[-1]))


def curve(rows: pd.DataFrame, contact: str, scene: str) -> tuple[np.ndarray, np.ndarray]:
    """Speeds (rad/s) and rms (m) of the level `standard` on GRID."""
    part = rows[(rows.contact == contact) & (rows.scene == scene) & (rows.what == EVERY_SPEED) & (rows.nodes == STANDARD)]
    part = part[part["count"] == USUAL].sort_values("speed")
    return part.speed.to_numpy(), part.rms.to_numpy()


def standard(input: Any, output: Any, params: Any) -> None:
    """Runs of a blade at the level `standard`: every speed, then each change. Params: blade."""
    runs = BladeRuns(settings_of(Path.cwd(), scenes="all"), params.blade, STANDARD)
    for model in map(Model, SCENES):
        contact, stress = runs.model(model)
        for scene in SCENES[model.contact]:
            run = partial(runs.run, model, contact, scene)
            steep = branch_speeds(GRID, run(GRID, EVERY_SPEED))
            for what in (AS_SHIPPED, *PERTURBED):
                run(np.union1d(SPREAD, steep), what, stress)
            for what in (*(f"step {step:g} s" for step in STEPS), "100 revolutions", "400 revolutions"):
                run(np.union1d(FEW, steep), what, stress)
            if scene == BARE or model.contact == POINTS:
                run(np.union1d(FEW, steep[1::2]), CENTRAL, stress)
            if scene != BARE:
                for what in (TWICE_THE_BARS, *(f"lining {times} times as stiff" for times in STIFFER)):
                    run(SPREAD[::2], what)
            elif params.blade in FRICTION_BLADES and model.contact == PATCHES:
                for value in FRICTION:
                    for what in ("", ", half the step", f", {CENTRAL}"):
                        run(FEW, f"friction {value:g}{what}")
        if params.blade == REFERENCE:
            runs.run(model, contact, BARE, PUBLISHED_RANGE, IN_PUBLISHED_RANGE)
    runs.write(output[0])


def on_mesh(input: Any, output: Any, params: Any) -> None:
    """Runs of a blade on another mesh, with the steps of its level. Input: the runs of `standard`. Params: blade, nodes."""
    known = pd.read_csv(input.standard)
    runs = BladeRuns(settings_of(Path.cwd(), scenes="all"), params.blade, params.nodes)
    for model in models_of(params.nodes):
        contact, _ = runs.model(model)
        for scene in SCENES[model.contact]:
            steep = branch_speeds(*curve(known, model.contact, scene))
            for what in ways_of(params.nodes, scene, model):
                # more contact nodes are expensive
                everywhere = SPREAD if model.count == USUAL else SPREAD[::2]
                runs.run(model, contact, scene, np.union1d(everywhere, steep), what)
        if params.nodes == FINEST:
            for times in STIFFER:
                runs.run(model, contact, SCENES[model.contact][-1], SPREAD[::2], f"lining {times} times as stiff")
        if params.blade in DRAWN and params.nodes in (5000, FINEST):
            runs.run(model, contact, BARE, GRID, EVERY_SPEED)
        if params.blade == REFERENCE and (params.nodes == FINEST or model.count == MOST):
            runs.run(model, contact, BARE, PUBLISHED_RANGE, IN_PUBLISHED_RANGE)
    runs.write(output[0])


def models_of(nodes: int) -> list[Model]:
    """Models of a mesh."""
    models = [Model(contact) for contact in SCENES]
    if nodes == SMALL:
        # as many patches by a cosine do not fit
        models += [
            Model(contact, count, spacing=EVEN if count == MOST else None) for contact in COUNTS for count in COUNTS[contact]
        ]
        models += [Model(PATCHES, modes=modes) for modes in MODES]
    return models


def ways_of(nodes: int, scene: str, model: Model) -> list[str]:
    """What is run on a mesh: the step of `standard`, and that of the level which has this mesh."""
    if nodes == SMALL and scene != BARE and model.count != USUAL:
        return []
    # of scenes with a bare casing, and of others
    steps = {(5000, True): 6.4e-6, (40000, True): 2.4e-6, (40000, False): 3.2e-6}
    own = steps.get((nodes, scene == BARE))
    return [AS_SHIPPED, *([f"step {own:g} s"] if own else [])]
