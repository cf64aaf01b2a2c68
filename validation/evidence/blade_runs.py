"""Models of a blade on the mesh of any level, and runs of them one speed at a time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from r37core.config import Settings
from r37core.contact.scene import Scene
from r37core.fem.matrices import assemble
from r37core.mesh.blade_mesh import BladeMesh
from r37core.mesh.generate import generate_mesh
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import ReducedModel, contact_model
from r37core.rom.region_choice import RegionChoice
from r37core.stress.operator import StressOperators, read_stress_operators
from r37core.stress.recovery import stress_operators
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.problem import UnstableStepError
from r37core.time_integration.speed_run import run_speed

AIRFOIL = "airfoil"
"""Region that decides."""


@dataclass(frozen=True)
class Models:
    """Models of a blade for contact and stress."""

    contact: ContactModel
    stress: StressOperators

    @classmethod
    def of(cls, reduced: ReducedModel, settings: Settings, blade: str) -> Models:
        """Those of a reduced model."""
        contact = contact_model(reduced, settings.boundary_choice(blade).tip_line)
        return cls(contact, stress_operators(reduced, settings.blades[blade].material))

    @classmethod
    def read(cls, contact: Path | str, stress: Path | str) -> Models:
        """Those of a run of the product, with the region that decides alone."""
        return cls(read_contact_model(contact), {AIRFOIL: read_stress_operators(stress)[AIRFOIL]})


def mesh_of(settings: Settings, blade: str) -> BladeMesh:
    """Mesh of a blade at the level of the settings."""
    mesh = settings.fidelity.mesh
    return generate_mesh(settings.blades[blade].shape.build(round_edges=True), mesh.nodes, mesh.layers, mesh.tip_elements)


def reduced_model(
    mesh: BladeMesh, settings: Settings, blade: str, regions: Mapping[str, RegionChoice] | None = None, **boundary: Any
) -> ReducedModel:
    """Reduced model of a blade, with another boundary or other regions of the stress than the one that decides."""
    material, regions = settings.blades[blade].material, regions or {AIRFOIL: settings.stress_regions(blade)[AIRFOIL]}
    boundary_choice = replace(settings.boundary_choice(blade), **boundary)
    return reduce_blade(mesh, assemble(mesh, material), material, boundary_choice, settings.reduction_choice(blade), regions)


def numbers_of_run(models: Models, speed: float, scene: Scene, choice: IntegrationChoice, *results: str) -> dict[str, Any]:
    """A run's numbers, and `motion` (m), rms of the leading edge, and `largest` (Pa), median of its largest stresses by region.

    NaN where its step is refused.
    """
    results = (*results, "stress", "static_stress")
    try:
        run = run_speed(
            models.contact, speed, scene, choice, results, stress=models.stress, spectrum_highest_order=1, wear_angles=500
        )
    except UnstableStepError:
        return {"motion": np.nan, "largest": np.full(len(models.stress), np.nan), "largest_penetration": np.nan}
    motion = float(np.hypot(run["rms_normal"][0], run["rms_tangential"][0]))
    largest = np.median(run["revolution_von_mises"], axis=1)
    return run | {"motion": motion, "largest": largest}


def speeds_about_crossing(contact: ContactModel, shares: Sequence[float], engine_order: int = 4) -> list[float]:
    """Speeds (rad/s) at shares of that where the first mode crosses an engine order."""
    speed = 0.0
    for _ in range(20):
        speed = float(contact.modes_at(speed)[0][0]) / engine_order
    return [share * speed for share in shares]


def with_friction(scene: Scene, share: float, value: float | None = None) -> Scene:
    """A scene with a share of its coefficient of friction, or of another value."""
    coefficient = scene.friction.coefficient if value is None else value
    return replace(scene, friction=replace(scene.friction, coefficient=share * coefficient))
