"""Models of blades that studies need beside those of the sweep, and names that a study may use."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, TypeVar

from r37core.blade.definition import BladeDefinition
from r37core.config import BladeSettings, ConfigError, SceneEntry, Settings, plain
from r37core.fem.material import Material
from r37core.plans import paths

Entry = TypeVar("Entry")

PARTS = {
    "nodes": r"\d+",
    "boundary_nodes": r"\d+",
    "fixed_interface_modes": r"\d+",
    "region": "submesh|whole",
    "tip_line": "pressure_edge|camber|suction_edge",
    "ends": "corners|inside",
}
"""Parts of a model's name, and the pattern of each."""


@dataclass(frozen=True)
class StudyModels:
    """Models and names for the studies of a run. Methods with `wildcards` are parameters of rules."""

    settings: Settings

    def of_level(self, level: str, **changes: Any) -> dict[str, Any]:
        """Parts of the name of a fidelity level's model, with some changed."""
        entry, boundary = self.level(level), self.settings.structure.boundary
        return {
            "nodes": entry.mesh.nodes,
            "boundary_nodes": boundary.nodes,
            "fixed_interface_modes": entry.reduction.fixed_interface_modes,
            "region": "submesh",
            "tip_line": boundary.tip_line,
            "ends": "corners" if boundary.corners else "inside",
        } | changes

    def files(self, blade: str, model: Mapping[str, Any]) -> dict[str, str]:
        """The files of a blade's model."""
        self.blade(blade)
        names = {"rom": "rom.nc", "contact": "contact.npz", "cost": "cost.json"}
        return {kind: paths.fill(paths.STUDY_MODEL, blade=blade, file=file, **model) for kind, file in names.items()}

    def choice(self, wildcards: Any) -> dict[str, Any]:
        """What a model's name says, as fields of ModelChoice."""
        return {
            "nodes": int(wildcards.nodes),
            "boundary_nodes": int(wildcards.boundary_nodes),
            "fixed_interface_modes": int(wildcards.fixed_interface_modes),
            "whole_blade_stress": wildcards.region == "whole",
            "tip_line": wildcards.tip_line,
            "corners": wildcards.ends == "corners",
        }

    def material(self, wildcards: Any) -> dict[str, float]:
        """Material of a study's blade."""
        return asdict(self.material_of(wildcards.blade))

    def material_of(self, blade: str) -> Material:
        """Material of the blade of this name."""
        material = self.blade(blade).material
        assert material is not None
        return material

    def integration(self, level: str) -> dict[str, Any]:
        """The time integration of a fidelity level, with the stress of the last revolution and the energy balance."""
        return asdict(self.level(level).time_integration.choice())

    def level(self, name: str) -> Any:
        """A level of the fidelity file."""
        return _known("fidelity level", name, self.settings.levels)

    def blade(self, name: str) -> BladeSettings:
        """A blade of this run that is given by profiles: the studies mesh it in several ways."""
        blades = self.settings.blades
        return _known("blade", name, {name: one for name, one in blades.items() if isinstance(one.definition, BladeDefinition)})

    def scene_entry(self, name: str) -> SceneEntry:
        """A scene of the scenes file."""
        return _known("scene", name, self.settings.scene_entries)

    def plain_scene(self, name: str) -> dict[str, Any]:
        """A scene of the scenes file as plain values, to be changed and checked again."""
        return plain(self.scene_entry(name))


def _known(kind: str, name: str, entries: Mapping[str, Entry]) -> Entry:
    """The entry of this name; a study may name what this run leaves out, which matters only when the study is asked for."""
    if name not in entries:
        raise ConfigError(f"config.yaml: studies: found the {kind} '{name}'; allowed: {', '.join(entries)}")
    return entries[name]
