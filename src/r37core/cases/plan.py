"""What the rules of the studies ask for, and what a study may take from the settings of a run.

A study is a folder. Its `cases.py` has `cases(settings)`, what runs, by name; `values(settings)`, plain values for the report;
`inputs(settings)`, what the report reads beside their responses, if anything; `outputs(settings)`, its files by name, if there
are others than one table. Its `report.py` has `report(responses, files, values)`, the content of each output.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from importlib import import_module
from types import ModuleType
from typing import Any, TypeVar

from r37core.blade.definition import BladeDefinition
from r37core.config import BladeSettings, ConfigError, SceneEntry, Settings
from r37core.config.study_sections import StabilitySection, TradeoffSection
from r37core.contact.scene import Scene
from r37core.fem.material import Material
from r37core.plain import to_plain
from r37core.plans import paths
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.integrators import EXACT_MODAL

from .case import Case, ModelChoice, model_of_name

STUDIES = ("estimate", "tradeoff", "stability", "modelling_choices", "validation_ranges", "refinement", "gallery")

Entry = TypeVar("Entry")


class Studies:
    """What the rules of the studies ask for. A study that this run cannot make is refused when it is asked for."""

    def __init__(self, settings: Settings):
        self._settings = settings
        self._cases = cache(lambda study: _cases_of(settings, study))

    def outputs(self, study: str) -> dict[str, str]:
        """Files of a study."""
        plan = _plan(study)
        return plan.outputs(self._settings) if hasattr(plan, "outputs") else {"table": f"<results>/studies/{study}.md"}

    def inputs(self, study: str) -> Callable[[Any], dict[str, Any]]:
        """What a study is made of: the responses of its cases, and other results of this run."""
        plan = _plan(study)
        return lambda wildcards: {
            "cases": [paths.fill(paths.STUDY_CASE, study=study, case=name) for name in self._cases(study)],
            **(plan.inputs(self._settings) if hasattr(plan, "inputs") else {}),
        }

    def names(self, study: str) -> Callable[[Any], list[str]]:
        """Names of the cases, in the order of their files."""
        return lambda wildcards: list(self._cases(study))

    def values(self, study: str) -> Callable[[Any], dict[str, Any]]:
        """Plain values that the report needs."""
        return lambda wildcards: to_plain(_plan(study).values(self._settings))

    def case(self, wildcards: Any) -> dict[str, Any]:
        """A case as plain values."""
        return to_plain(self._case(wildcards))

    def case_inputs(self, wildcards: Any) -> dict[str, str]:
        """Files that a case is run from."""
        case = self._case(wildcards)
        if isinstance(case.model, str):
            where = {"blade": case.blade, "tip_line": case.model}
            files = {"rom": paths.fill(paths.REDUCED_MODEL, **where), "contact": paths.fill(paths.CONTACT_MODEL, **where)}
        else:
            where = {"blade": case.blade, "model": case.model.name}
            names = {"rom": "rom.nc", "contact": "contact.npz", "cost": "cost.json"}
            files = {kind: paths.fill(paths.STUDY_MODEL, **where, file=name) for kind, name in names.items()}
        if "stress" not in case.results:
            del files["rom"]
        if case.crossing:
            files["campbell"] = paths.fill(paths.CAMPBELL, blade=case.blade)
        if case.swept_peak:
            files["response"] = paths.fill(paths.RESPONSE, blade=case.blade, scene=case.swept_peak.scene)
        return files

    def _case(self, wildcards: Any) -> Case:
        cases = self._cases(wildcards.study)
        if wildcards.case not in cases:
            raise ConfigError(f"study {wildcards.study}: found the case '{wildcards.case}'; allowed: {', '.join(cases)}")
        return cases[wildcards.case]

    def model(self, wildcards: Any) -> dict[str, Any]:
        """What a model's name says."""
        return to_plain(model_of_name(wildcards.model))

    def material(self, wildcards: Any) -> dict[str, Any]:
        """Material of a study's blade."""
        return to_plain(material_of(self._settings, wildcards.blade))


def _plan(study: str) -> ModuleType:
    return import_module(f"r37core.studies.{study}.cases")


def _cases_of(settings: Settings, study: str) -> dict[str, Case]:
    """Cases of a study; ConfigError for one that steps with central differences where the Coriolis force is wanted."""
    cases = _plan(study).cases(settings)
    if settings.structure.coriolis and any(case.choice.integrator != EXACT_MODAL for case in cases.values()):
        path, value = ("structure", "coriolis"), f"true in the study {study}, which runs central differences, too"
        raise settings.documents.config.refusal(path, value, "false; only exact_modal carries the Coriolis force")
    return cases


def campbell_file(blade: str, model: ModelChoice | str) -> str:
    """Campbell diagram of a model: of a study, or this run's own on the tip line of this name."""
    if isinstance(model, str):
        return paths.fill(paths.CAMPBELL, blade=blade)
    return paths.fill(paths.STUDY_MODEL, blade=blade, model=model.name, file="campbell.nc")


def level_of(settings: Settings, name: str) -> Any:
    """A level of the fidelity file."""
    return _known("fidelity level", name, settings.levels)


def blade_of(settings: Settings, name: str) -> BladeSettings:
    """A blade of this run that is given by profiles: the studies mesh it in several ways."""
    return _known("blade", name, _with_profiles(settings))


def blade_name_of(settings: Settings, section: TradeoffSection | StabilitySection) -> str:
    """The blade that a study is of: if none is named, the first that it can mesh; ConfigError without any."""
    if section.blade is None and not _with_profiles(settings):
        raise ConfigError(f"{settings.documents.blades.name}: no blade with profiles is run; the study needs one")
    return section.blade or next(iter(_with_profiles(settings)))


def _with_profiles(settings: Settings) -> dict[str, BladeSettings]:
    return {blade: entry for blade, entry in settings.blades.items() if isinstance(entry.definition, BladeDefinition)}


def material_of(settings: Settings, blade: str) -> Material:
    """Material of the blade of this name."""
    material = blade_of(settings, blade).material
    assert material is not None
    return material


def scene_entry_of(settings: Settings, name: str) -> SceneEntry:
    """A scene of the scenes file."""
    return _known("scene", name, settings.scene_entries)


def model_of_level(settings: Settings, level: str) -> ModelChoice:
    """The model of a fidelity level."""
    entry, boundary = level_of(settings, level), settings.structure.boundary
    return ModelChoice(
        nodes=entry.mesh.nodes,
        boundary_nodes=boundary.nodes,
        fixed_interface_modes=entry.reduction.fixed_interface_modes,
        whole_blade_stress=False,
        tip_line=boundary.tip_line,
        corners=boundary.corners,
    )


def integration_of_level(settings: Settings, level: str, scene: Scene | None) -> IntegrationChoice:
    """The time integration of a fidelity level in a scene."""
    return level_of(settings, level).time_integration.choice(scene is not None and scene.lining is not None)


def kept_of(level: Any) -> dict[str, int]:
    """How much of a run a level's files keep."""
    section = level.time_integration
    return {"spectrum_highest_order": section.spectrum_highest_order, "wear_angles": section.wear_angles}


def case_of_sweep(settings: Settings, blade: str, scene: str, **fields: Any) -> Case:
    """A case of this run's own model, scene and time integration; `fields`: at least speeds and results."""
    chosen = settings.scenes[scene]
    own = {
        "blade": blade,
        "model": chosen.tip_line,
        "scene": chosen.scene,
        "choice": settings.integration_choice(blade, scene, settings.structure.maximum_speed_rad_s),
        "material": settings.blades[blade].material,
        "kept": kept_of(settings.fidelity),
    }
    return Case(**{**own, **fields})


def _known(kind: str, name: str, entries: Mapping[str, Entry]) -> Entry:
    """The entry of this name; a study may name what this run leaves out, which matters only when the study is asked for."""
    if name not in entries:
        allowed = ", ".join(entries) or f"none, because no {kind} of this run will do"
        raise ConfigError(f"config.yaml: the study needs the {kind} '{name}'; allowed in this run: {allowed}")
    return entries[name]
