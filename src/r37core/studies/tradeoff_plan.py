"""The plan of the study `tradeoff`: one case for each value of each parameter."""

from __future__ import annotations

from functools import cached_property
from typing import Any

from r37core.config import ConfigError, Settings, plain
from r37core.config.studies import TradeoffSection
from r37core.contact.scene import Scene
from r37core.plans import paths
from r37core.speeds import exact_text

from .parameters import LEVEL, OF_THE_MODEL
from .study_models import StudyModels


class Tradeoff:
    """Plan of the study. Methods with `wildcards` are inputs and parameters of rules; ConfigError if there is no study."""

    def __init__(self, settings: Settings):
        self._settings = settings
        self._models = StudyModels(settings)
        given = settings.studies.tradeoff
        parameters = given.parameters.given() if given else {}
        self.values = {name: [text_of(value) for value in parameter.values] for name, parameter in parameters.items()}
        self.references = {name: text_of(parameter.reference) for name, parameter in parameters.items()}

    @cached_property
    def section(self) -> TradeoffSection:
        """The section of config.yaml."""
        if self._settings.studies.tradeoff is None:
            raise ConfigError("config.yaml: studies.tradeoff: missing; the study needs its parameters, as in the shipped file")
        return self._settings.studies.tradeoff

    def cases(self, wildcards: Any) -> list[str]:
        """All cases."""
        blade = self.section.blade
        return [
            paths.fill(paths.TRADEOFF_CASE, blade=blade, parameter=parameter, value=value)
            for parameter, values in self.values.items()
            for value in values
        ]

    def model(self, wildcards: Any) -> dict[str, str]:
        """Files of the model that a parameter's value needs."""
        parameter, value, base = wildcards.parameter, wildcards.value, self.section.base
        changed = {OF_THE_MODEL[parameter]: value} if parameter in OF_THE_MODEL else {}
        return self._models.files(wildcards.blade, self._models.of_level(value if parameter == LEVEL else base, **changed))

    @property
    def _scene_names(self) -> list[str]:
        return list(self._settings.scenes) if self.section.scenes == "all" else list(self.section.scenes)

    def scenes(self, wildcards: Any) -> dict[str, Scene]:
        """The scenes that are run."""
        return {name: self._models.scene_entry(name).scene() for name in self._scene_names}

    def described(self, wildcards: Any) -> list[str]:
        """The scenes as texts, which re-run a case when they change."""
        return [repr(scene) for scene in self.scenes(wildcards).values()]

    def choices(self, wildcards: Any) -> dict[str, dict[str, Any]]:
        """The time integration of every scene, before the parameter is turned."""
        level = wildcards.value if wildcards.parameter == LEVEL else self.section.base
        return {name: self._models.integration(level) for name in self._scene_names}

    def places(self, wildcards: Any) -> dict[str, Any]:
        """Neighbouring speeds, as shares of the Campbell speed."""
        return plain(self.section.places)

    def engine_order(self, wildcards: Any) -> int:
        """Whose crossing with 1B the speeds lie about."""
        return self.section.engine_order

    def provenance(self, wildcards: Any) -> dict[str, str]:
        """Attributes of the study's dataset."""
        return {"blade": self.section.blade, "base_level": self.section.base}


def text_of(value: float | str) -> str:
    """A parameter's value as it stands in file names."""
    return value if isinstance(value, str) else exact_text(value)
