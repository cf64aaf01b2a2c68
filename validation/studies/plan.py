"""What the studies of the benchmark take from the settings of a run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from r37core.cases.case import Case, ModelChoice
from r37core.cases.plan import MODEL_FILE, case_of_sweep, integration_of_level, kept_of
from r37core.config import ConfigError, SceneEntry, Settings
from r37core.fem.material import Material
from r37core.plans import paths

Entry = TypeVar("Entry")

STUDY_CASE = "<results>/validation/{study}/{case}.nc"

__all__ = ["case_of_sweep", "integration_of_level", "kept_of"]


@dataclass(frozen=True)
class SweptPeak:
    """The speed of the largest motion in this run's sweep of a scene, from `first` to `last` rad/s."""

    scene: str
    first: float
    last: float


@dataclass(frozen=True)
class StudyCase(Case):
    """A case with what the studies need in addition.

    - `swept_peak`: that speed is among the speeds, too.
    - `follow`: more speeds at the same step while the ends of the range are above yield. The peak's stress history is kept.
    """

    swept_peak: SweptPeak | None = None
    follow: bool = False


def campbell_file(blade: str, model: ModelChoice | str) -> str:
    """Campbell diagram of a model: of a study, or this run's own on the tip line of this name."""
    if isinstance(model, str):
        return paths.fill(paths.CAMPBELL, blade=blade)
    return paths.fill(MODEL_FILE, blade=blade, model=model.name, file="campbell.nc")


def level_of(settings: Settings, name: str) -> Any:
    """A level of the fidelity file."""
    return _known("fidelity level", name, settings.levels)


def material_of(settings: Settings, blade: str) -> Material:
    """Material of the blade of this name."""
    material = _known("blade", blade, settings.blades).material
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


def _known(kind: str, name: str, entries: Mapping[str, Entry]) -> Entry:
    """The entry of this name; ConfigError where this run leaves it out."""
    if name not in entries:
        allowed = ", ".join(entries) or f"none, because no {kind} of this run will do"
        raise ConfigError(f"config.yaml: the study needs the {kind} '{name}'; allowed in this run: {allowed}")
    return entries[name]
