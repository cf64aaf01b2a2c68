"""The plan of the study `stability`: one job for each extreme."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from r37core.config import ConfigError, Settings, checked_scene
from r37core.contact.scene import Scene
from r37core.plans import paths

from .changes import changed
from .stability_cases import extremes
from .study_models import StudyModels


class Stability:
    """Plan of the study. Methods with `wildcards` are inputs and parameters of rules."""

    def __init__(self, settings: Settings):
        self._section = settings.studies.stability
        self._models = StudyModels(settings)
        self._extremes = {one.name: one for one in extremes(self._section.lined_scene, self._section.direct_scene)}

    @property
    def cases(self) -> list[str]:
        """All extremes."""
        return [paths.fill(paths.STABILITY_CASE, extreme=name) for name in self._extremes]

    def model(self, wildcards: Any) -> str:
        """Contact model of an extreme."""
        model = self._models.of_level(self._section.base, **self._extremes[wildcards.extreme].model)
        return self._models.files(self._section.blade, model)["contact"]

    def extreme(self, wildcards: Any) -> dict[str, Any]:
        """What is tried."""
        return asdict(self._extremes[wildcards.extreme])

    def choice(self, wildcards: Any) -> dict[str, Any]:
        """The time integration, before it is changed."""
        return self._models.integration(self._section.base)

    def scene(self, wildcards: Any) -> Scene | None:
        """The changed scene, which Snakemake does not compare; None where the configuration refuses it."""
        checked = self._checked(wildcards)
        return checked if isinstance(checked, Scene) else None

    def described(self, wildcards: Any) -> str:
        """The changed scene as a text, which re-runs a job when it changes, or why the configuration refuses it."""
        checked = self._checked(wildcards)
        return repr(checked) if isinstance(checked, Scene) else checked

    def _checked(self, wildcards: Any) -> Scene | str:
        extreme = self._extremes[wildcards.extreme]
        try:
            return checked_scene(changed(self._models.plain_scene(extreme.scene), extreme.changes))
        except ConfigError as error:
            if extreme.scene not in self._models.settings.scene_entries:
                raise
            return str(error)
