"""The parameters whose price the trade-off study measures: what each of them changes.

Their values' types and bounds are those of r37core.config.studies; a test holds the names together.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from r37core.contact.scene import Scene
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

LEVEL = "level"
"""The parameter that changes everything at once: the fidelity level."""

OF_THE_MODEL = {
    "mesh_nodes": "nodes",
    "boundary_nodes": "boundary_nodes",
    "fixed_interface_modes": "fixed_interface_modes",
    "stress_region": "region",
}
"""Parameter -> part of a study model's name."""

OF_THE_INTEGRATION: Mapping[str, Callable[[str], dict[str, Any]]] = {
    "central_difference_step": lambda value: {"time_step": float(value), "integrator": CENTRAL_DIFFERENCE},
    "exact_modal_step": lambda value: {"time_step": float(value), "integrator": EXACT_MODAL},
    "revolutions": lambda value: {"revolutions": int(value)},
    "highest_frequency": lambda value: {"highest_frequency": float(value)},
    "stress_instants": lambda value: {"snapshots_per_revolution": int(value)},
}
"""Parameter -> fields of IntegrationChoice, from a value's text."""


def _with_bars(scene: Scene, value: str) -> Scene:
    return replace(scene, lining=scene.lining and replace(scene.lining, bars=int(value)))


def _with_friction(scene: Scene, value: str) -> Scene:
    return replace(scene, friction=scene.friction and replace(scene.friction, vector=value == "vector"))


OF_THE_SCENE: Mapping[str, Callable[[Scene, str], Scene]] = {"bars": _with_bars, "friction_form": _with_friction}
"""Parameter -> the scene with a value, from its text."""

PARAMETERS = (LEVEL, *OF_THE_INTEGRATION, *OF_THE_MODEL, *OF_THE_SCENE)


def vary(parameter: str, value: str, scene: Scene, choice: IntegrationChoice) -> tuple[Scene, IntegrationChoice]:
    """Scene and time integration with one parameter set; the level and parameters of the model change neither.

    Raises ValueError for an unknown parameter.
    """
    if parameter not in PARAMETERS:
        raise ValueError(f"unknown parameter {parameter}")
    if parameter in OF_THE_SCENE:
        return OF_THE_SCENE[parameter](scene, value), choice
    if parameter in OF_THE_INTEGRATION:
        return scene, replace(choice, **OF_THE_INTEGRATION[parameter](value))
    return scene, choice
