"""The plan of the study `readings`: one job for each reading, blade and window of speeds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from r37core.config import Settings, checked_scene, plain
from r37core.contact.scene import Scene
from r37core.plans import paths
from r37core.published import BLADES, REFERENCE

from .changes import changed
from .reading_list import READINGS
from .reading_places import Place, places
from .study_models import StudyModels

MESHES = (10000, 40000)
"""Nodes of the meshes whose Campbell diagrams are compared."""


class Readings:
    """Plan of the study. Methods with `wildcards` are inputs and parameters of rules."""

    def __init__(self, settings: Settings):
        self._settings, self._section = settings, settings.studies.readings
        self._models = StudyModels(settings)
        steps = plain(self._section.speed_steps_rad_s)
        self._places = {name: places(reading, steps) for name, reading in READINGS.items()}
        self.runs = [(reading, place) for reading, found in self._places.items() for place in found]
        self.campbells = [(blade, "level") for blade in BLADES] + [(REFERENCE, str(nodes)) for nodes in MESHES]

    @property
    def run_files(self) -> list[str]:
        """All runs."""
        return [paths.fill(paths.READING, reading=reading, place=place) for reading, place in self.runs]

    @property
    def campbell_files(self) -> list[str]:
        """All Campbell diagrams."""
        return [paths.fill(paths.READING_CAMPBELL, blade=blade, mesh=mesh) for blade, mesh in self.campbells]

    def model(self, wildcards: Any) -> dict[str, str]:
        """Files of the model that a reading needs."""
        return self._structure(self._place(wildcards).blade, READINGS[wildcards.reading].model)

    def campbell_model(self, wildcards: Any) -> str:
        """Reduced model of a Campbell diagram: with the mesh of the readings' level, or one of so many nodes."""
        changes = {} if wildcards.mesh == "level" else {"nodes": int(wildcards.mesh)}
        return self._structure(wildcards.blade, changes)["rom"]

    def reading(self, wildcards: Any) -> dict[str, Any]:
        """What is read otherwise."""
        return asdict(READINGS[wildcards.reading])

    def place(self, wildcards: Any) -> dict[str, Any]:
        """Where it is run."""
        return asdict(self._place(wildcards))

    def scene(self, wildcards: Any) -> Scene:
        """The changed scene, which Snakemake does not compare."""
        entry = self._models.plain_scene(getattr(self._section, f"{self._place(wildcards).kind}_scene"))
        return checked_scene(changed(entry, READINGS[wildcards.reading].changes))

    def described(self, wildcards: Any) -> str:
        """The changed scene as a text, which re-runs a job when it changes."""
        return repr(self.scene(wildcards))

    def choice(self, wildcards: Any) -> dict[str, Any]:
        """The time integration of the readings' level, or of their quick one."""
        level = self._section.quick if READINGS[wildcards.reading].quick else self._section.base
        return self._models.integration(level)

    def material(self, wildcards: Any) -> dict[str, float]:
        """Material of a reading's blade."""
        return asdict(self._models.material_of(self._place(wildcards).blade))

    def yield_stress(self, wildcards: Any) -> float:
        """Of the reference blade (Pa)."""
        return self._models.material_of(REFERENCE).yield_stress

    def _place(self, wildcards: Any) -> Place:
        return self._places[wildcards.reading][wildcards.place]

    def _structure(self, blade: str, changes: Mapping[str, Any]) -> dict[str, str]:
        """Files of a model: this run's own where that is the same."""
        self._models.blade(blade)
        if not changes and self._same_as_this_run:
            where = {"blade": blade, "tip_line": self._settings.structure.boundary.tip_line}
            return {"rom": paths.fill(paths.REDUCED_MODEL, **where), "contact": paths.fill(paths.CONTACT_MODEL, **where)}
        files = self._models.files(blade, self._models.of_level(self._section.base, **changes))
        return {name: files[name] for name in ("rom", "contact")}

    @property
    def _same_as_this_run(self) -> bool:
        level, mine = self._models.level(self._section.base), self._settings.fidelity
        return (level.mesh, level.reduction) == (mine.mesh, mine.reduction)
