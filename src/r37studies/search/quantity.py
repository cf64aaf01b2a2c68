"""Numbers of a design that objectives and constraints are made of: of contact, of its modes, and of its structure."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.operator import StressOperator

from .measures import OF_ENDED_RUNS

if TYPE_CHECKING:
    # the workflow imports it before it knows whether there is a search
    import xarray as xr

    from .section import QuantitySection


def static_stress(stress: StressOperator, stiffening: np.ndarray, speeds: Sequence[float]) -> dict[float, float]:
    """Largest von Mises stress (Pa) by rotation alone at each speed (rad/s); `stiffening` as rotation_amplitudes has it."""
    still = np.zeros((len(speeds), stress.coordinates))
    amplitudes = rotation_amplitudes(stiffening, np.array(speeds))
    return dict(zip(speeds, stress.max_von_mises(np.concatenate([still, amplitudes], axis=1)).tolist(), strict=True))


def structure_value(
    quantity: QuantitySection, mass: float, campbell: xr.Dataset, static_stress: Mapping[float, float], highest_speed: float
) -> float:
    """The value of a quantity without contact.

    `mass` (kg) and the Campbell diagram of the blade; `static_stress` (Pa) by rotation at the speeds (rad/s) that are asked
    for; `highest_speed` (rad/s): where it is taken that names no speed. Raises KeyError for a mode or engine order that the
    diagram does not have.
    """
    if quantity.measure == "mass_kg":
        return mass
    if quantity.measure == "static_stress_pa":
        return static_stress[quantity.speed_rad_s or highest_speed]
    mode_data = campbell.sel(mode=quantity.mode)
    if quantity.measure == "clearance_loss_m":
        return -float(mode_data["dynamic_clearance"].min())
    speed = quantity.speed_rad_s or 0.0
    if quantity.measure == "crossing_margin_percent":
        crossing = float(mode_data["crossing_speed"].sel(engine_order=quantity.engine_order))
        # a mode that never meets the engine order is as far from it as can be
        return 100.0 * abs(crossing / speed - 1.0) if math.isfinite(crossing) else 100.0
    return float(np.interp(speed, mode_data["speed"], mode_data["frequency"]))


def contact_value(quantity: QuantitySection, measures: Mapping[str, Mapping[str, float]]) -> tuple[float, float]:
    """Value of a quantity of contact and its standard deviation, NaN where that is not known: of the worst scene.

    `measures`: scene -> measure -> its value, with the scatter of those that have one.
    """
    scatter = f"{quantity.measure.removesuffix('_rad_s')}_scatter_rad_s"
    scene_measures = [measures[scene] for scene in quantity.scenes or ()]
    values = [(_run_value(quantity.measure, known), known.get(scatter, math.nan)) for known in scene_measures]
    return max(values, key=lambda value: value[0])


def _run_value(measure: str, robustness: Mapping[str, float]) -> float:
    return math.inf if measure in OF_ENDED_RUNS and robustness["diverged_runs"] else robustness[measure]
