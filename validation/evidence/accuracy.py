"""Accuracy of the levels on seven blades, against a finer reference and against chance (docs/accuracy.md)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pandas as pd

from r37core.base.io import atomic_write
from r37core.rom.contact_model import write_contact_model
from r37core.stress.operator import write_stress_operators

from .blade_runs import Models, mesh_of, numbers_of_run, reduced_model, speeds_about_crossing, with_friction
from .configuration import settings_of
from .tables import write_table

LEVELS = ("draft", "standard", "fine")
REFERENCE, PERTURBED, STRONG, STRONG_PERTURBED = "reference", "friction + 0.1%", "friction 0.3", "friction 0.3 + 0.1%"

SHARES = (0.97, 0.98, 0.99, 1.0, 1.01, 1.02, 1.03, 1.04)
"""Speeds on the lining, as shares of that of 1B/4."""

BARE_SPEEDS = (1000.0, 1200.0, 1400.0, 1600.0, 1800.0)
"""Speeds (rad/s) on the bare casing."""


@dataclass(frozen=True)
class Case:
    """A level with a share of its step and of the friction, or of another coefficient of it."""

    level: str
    step: float = 1.0
    friction: float = 1.0
    coefficient: float | None = None


CASES = {
    **{level: Case(level) for level in LEVELS},
    REFERENCE: Case("fine", step=0.5),
    PERTURBED: Case("standard", friction=1.001),
    STRONG: Case("standard", coefficient=0.3),
    STRONG_PERTURBED: Case("standard", friction=1.001, coefficient=0.3),
}


def fine_models(input: Any, output: Any, params: Any) -> None:
    """Models of a blade at `fine`. Params: blade, configuration. Outputs: contact, stress."""
    models = models_at("fine", params)
    write_contact_model(models.contact, output.contact)
    write_stress_operators(models.stress, output.stress)


def models_at(level: str, params: Any) -> Models:
    """Models of a blade at a level."""
    settings = settings_of(Path.cwd(), **params.configuration, fidelity=level)
    return Models.of(reduced_model(mesh_of(settings, params.blade), settings, params.blade), settings, params.blade)


def runs_of_blade(input: Any, output: Any, params: Any) -> None:
    """Runs of a blade in all cases. Inputs: its models at `standard` and `fine`. Params: blade, configuration."""
    rows, speeds = [], []
    for level in ("standard", "draft", "fine"):
        settings = settings_of(Path.cwd(), **params.configuration, fidelity=level)
        models = Models.read(*input[level]) if level in input else models_at(level, params)
        speeds = speeds or speeds_about_crossing(models.contact, SHARES)
        for name, case in CASES.items():
            if case.level == level:
                rows += _runs(models, settings, name, params.blade, speeds)
    with atomic_write(output.runs) as new:
        pd.DataFrame(rows).to_csv(new, index=False, float_format="%.8g")


def _runs(models: Models, settings: Any, name: str, blade: str, lined: Any) -> Iterator[dict[str, Any]]:
    """Rows of a case in both scenes. The last scene is the bare casing."""
    case = CASES[name]
    for scene, chosen in settings.scenes.items():
        is_bare = chosen.scene.lining is None
        if case.coefficient and not is_bare:
            continue
        varied = with_friction(chosen.scene, case.friction, case.coefficient)
        for share, speed in zip(BARE_SPEEDS if is_bare else SHARES, BARE_SPEEDS if is_bare else lined, strict=True):
            choice = settings.integration_choice(blade, scene)
            # of the step that the level has here
            run = numbers_of_run(models, speed, varied, replace(choice, time_step=case.step * choice.time_step))
            row = {"blade": blade, "case": name, "scene": "bare" if is_bare else "lining", "share": share, "speed": speed}
            columns = {"motion": run["motion"], "stress": run["largest"][0], "penetration": float(run["largest_penetration"])}
            yield row | columns | {"step": 1e6 * choice.time_step}


class Runs:
    """Rows of all blades. `errors`: differences in percent at each speed of the tables, by blade."""

    def __init__(self, files: list[str]):
        self.rows = pd.concat([pd.read_csv(file) for file in files], ignore_index=True)
        self.blades = list(dict.fromkeys(self.rows.blade))

    def of(self, case: str, scene: str, quantity: str = "motion") -> pd.Series:
        """A quantity of a case by blade and speed."""
        rows = self.rows[(self.rows.case == case) & (self.rows.scene == scene)]
        return rows.set_index(["blade", "speed"])[quantity]

    def errors(self, case: str, against: str, scene: str, quantity: str = "motion") -> pd.Series:
        """Differences (%) of a case by blade and speed."""
        return 100.0 * abs(self.of(case, scene, quantity) / self.of(against, scene, quantity) - 1.0)

    def compared(self, case: str, scene: str, quantity: str = "motion") -> pd.Series:
        """Errors of a level against the reference, and of a perturbation against what it perturbs."""
        against = {PERTURBED: "standard", STRONG_PERTURBED: STRONG}.get(case, REFERENCE)
        return self.errors(case, against, scene, quantity)


def percent(value: float) -> str:
    """A percentage in two digits."""
    return f"{value:.1f}%" if value < 9.95 else f"{value:.0f}%"


def worst(errors: pd.Series) -> tuple[str, float]:
    """The blade with the largest median, and that median."""
    medians = errors.groupby("blade", sort=False).median()
    return str(medians.idxmax()), float(medians.max())


def tables(input: Any, output: Any, params: Any) -> None:
    """Levels, blades, friction and penetration. Input: `patches`, files of runs."""
    runs = Runs(input.patches)
    write_table(*_levels(runs), output.levels)
    write_table(*_by_blade(runs, LEVELS), output.blades)
    write_table(*_friction(runs), output.friction)
    write_table(*_penetration(runs), output.penetration)


def _levels(runs: Runs) -> tuple[list[str], list[list[str]]]:
    """Errors of the worst blade: medians over the speeds of motion and stress, and the largest of any blade and speed."""
    rows = []
    for case in (*LEVELS, PERTURBED):
        errors = [runs.compared(case, *pair) for pair in (("lining",), ("bare",), ("bare", "stress"))]
        medians = [f"{percent(median)} ({blade})" for blade, median in map(worst, errors)]
        largest = " / ".join(percent(runs.compared(case, scene).max()) for scene in ("lining", "bare"))
        steps = [runs.of(case, scene, "step").median() for scene in ("lining", "bare")]
        words = [f"`{case}`", f"{steps[0]:.1f} / {steps[1]:.1f}"] if case in LEVELS else [f"{case} (`standard`)", ""]
        rows.append([*words, *medians, largest])
    head = ["level", "step, lining / bare (us)", "lining: rms", "bare casing: rms", "bare casing: stress"]
    return [*head, "largest error of rms, lining / bare"], rows


def _by_blade(runs: Runs, cases: tuple[str, ...]) -> tuple[list[str], list[list[str]]]:
    """Median and largest error of rms of each blade."""
    columns = [(scene, case) for scene in ("lining", "bare") for case in cases]
    rows = [[blade, *(_cell(runs.compared(case, scene).loc[blade]) for scene, case in columns)] for blade in runs.blades]
    return ["blade", *(f"{scene}, {case}: median; largest" for scene, case in columns)], rows


def _cell(errors: pd.Series) -> str:
    return f"{percent(errors.median())}; {percent(errors.max())}"


def _friction(runs: Runs) -> tuple[list[str], list[list[str]]]:
    """What 0.1% more friction changes in rms and stress."""
    columns = {
        "lining: rms": (PERTURBED, "lining"),
        "lining: stress": (PERTURBED, "lining", "stress"),
        "bare: rms": (PERTURBED, "bare"),
        "bare: stress": (PERTURBED, "bare", "stress"),
        "bare, coefficient 0.3: rms": (STRONG_PERTURBED, "bare"),
    }
    rows = [[blade, *(_cell(runs.compared(*of).loc[blade]) for of in columns.values())] for blade in runs.blades]
    return ["blade", *(f"{name}: median; largest" for name in columns)], rows


def _penetration(runs: Runs) -> tuple[list[str], list[list[str]]]:
    """Largest penetration of the edge into the bare casing (um)."""
    largest = [1e6 * runs.of(level, "bare", "penetration").groupby("blade").max() for level in LEVELS]
    rows = [[blade, *(f"{values[blade]:.0f}" for values in largest)] for blade in runs.blades]
    return ["blade", *(f"{level} (um)" for level in LEVELS)], rows
