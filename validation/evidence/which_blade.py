"""Models of a blade in files of a run, and lengths above yield from runs of its own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

from r37core.config import Settings
from r37core.contact.scene import Scene
from r37core.results.columns import MOST_REVOLUTIONS
from r37core.results.exceedance import Exceedance, exceedance_of
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.stress.operator import StressOperator, judged_operator, read_stress_operators
from r37core.stress.statistic import stress_statistic
from r37core.time_integration.speed_run import run_speed

SCENES = {"abradable": "lining", "direct": "bare casing"}
"""Scenes of the benchmark, and what they are in words."""

ON_PATCHES = {"abradable": "material_abradable", "direct": "direct"}
"""Scenes on patches, which the published lining is not made for."""

KEPT = {"spectrum_highest_order": 1, "wear_angles": 1}


@dataclass(frozen=True)
class Models:
    """A blade's contact model and its stress operator."""

    contact: ContactModel
    stress: StressOperator

    @classmethod
    def read(cls, contact: str, stress: str) -> Models:
        """Models in two files of a run."""
        return cls(read_contact_model(contact), judged_operator(read_stress_operators(stress)))


def length_text(length: float, scatter: float = np.nan) -> str:
    """A length (rad/s), with its scatter where it is above 0."""
    return f"{length:.0f}" + (f" ± {max(scatter, 1.0):.0f}" if scatter > 0.0 else "")


def length_of_runs(settings: Settings, models: Models, blade: str, scene: Scene, speeds: np.ndarray) -> float:
    """Length (rad/s) above yield in most revolutions, from runs of its own."""
    return exceedance_of_runs(settings, models, blade, scene, speeds).length(MOST_REVOLUTIONS)


def exceedance_of_runs(settings: Settings, models: Models, blade: str, scene: Scene, speeds: np.ndarray) -> Exceedance:
    """Exceedance of a blade from runs of its own, in a scene like the shipped one with a lining or without."""
    limit, shares, lined = settings.blades[blade].material.yield_stress, [], scene.lining is not None
    name = next(name for name, chosen in settings.scenes.items() if (chosen.scene.lining is not None) == lined)
    for speed in speeds:
        choice = settings.integration_choice(blade, name, float(speed))
        run = run_speed(models.contact, float(speed), scene, choice, ("stress",), stress={"judged": models.stress}, **KEPT)
        statistic = stress_statistic(run["revolution_von_mises"][0], limit)
        shares.append(1.0 if run["status"] else float(statistic["share_of_revolutions_above_yield"]))
    coordinates = {"speed": np.asarray(speeds, float)}
    content = {"share_of_revolutions_above_yield": ("speed", shares), "status": ("speed", np.zeros(len(shares), int))}
    return exceedance_of(xr.Dataset(content | {"lined": float(lined)}, coordinates))
