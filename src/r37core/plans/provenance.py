"""Attributes of result files that say how they were made."""

from __future__ import annotations

import hashlib
import json
from collections import UserDict
from typing import TYPE_CHECKING, Any

from r37core.base.plain import to_json, to_plain
from r37core.rom.reduction_choice import LINEAR

if TYPE_CHECKING:
    from r37core.config import Settings


class Attributes(UserDict[str, Any]):
    """Attributes of a file. As a rule's parameter they re-run nothing: Snakemake compares plain dictionaries, not this.

    What re-runs a job stands beside them: the numbers it computes with, its inputs and its code. So a mesh that serves two
    fidelity levels is made once, and names the level it was made for.
    """

    def __str__(self) -> str:
        return json.dumps(self.data)


def structure_provenance(settings: Settings, blade: str) -> Attributes:
    """Attributes of a blade's mesh, reduced model and Campbell diagram."""
    kinematics = settings.kinematics_of(blade)
    return Attributes(
        blade=blade,
        fidelity=settings.fidelity_name,
        contact=settings.contact_of(blade),
        **({} if kinematics == LINEAR else {"kinematics": kinematics}),
        input_hash=structure_hash(settings, blade),
    )


def sweep_provenance(settings: Settings, blade: str, scene: str) -> Attributes:
    """Attributes of the simulations of a blade and scene."""
    chosen, steps = settings.scenes[scene], settings.fidelity.time_integration
    return Attributes(
        settings.made(structure_provenance, blade),
        scene=scene,
        scene_parameters=to_json(chosen.scene),
        revolutions=chosen.revolutions,
        **({"until": "settled"} if chosen.until_settled else {}),
        largest_time_step=steps.largest_step(chosen.scene),
        # of the level, meshes and steps of all kinds of scenes, because its datasets may be joined; a rom.nc has its own mesh's
        numerics=f"{settings.fidelity.mesh.nodes} nodes unless imported, {steps.integrator} of {steps.wording}",
    )


def shape_hash(settings: Settings, blade: str) -> str:
    """Short hash of all that a blade's geometry depends on."""
    return _short_hash(settings.blades[blade].definition, settings.structure.edges)


def structure_hash(settings: Settings, blade: str) -> str:
    """Short hash of all that a blade's structural results depend on."""
    material = settings.blades[blade].material
    elastic = material and material.elastic
    mesh, reduction = settings.fidelity.mesh.model_dump(exclude_none=True), settings.reduction_choice(blade)
    # in this order, so that results keep their hash
    choices = {"boundary": settings.boundary_choice(blade), "speeds": reduction.speeds}
    disc = settings.blades[blade].disc
    choices |= {"disc": disc} if disc else {}
    choices |= {"stress_regions": settings.stress_regions(blade), **to_plain(reduction)}
    return _short_hash(shape_hash(settings, blade), elastic, mesh, choices)


def _short_hash(*parts: object) -> str:
    """Hash of plain numbers, texts and frozen dataclasses."""
    return hashlib.sha256(to_json(parts).encode()).hexdigest()[:16]
