"""The plan of `snakemake exports`: which files, from what, with which numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from r37core.blade.definition import BladeDefinition
from r37core.config import si_fields
from r37core.exchange.importing.source import MeshSource
from r37core.exchange.orientation import OURS
from r37core.plain import to_plain
from r37core.speeds import exact_text

from . import paths
from .import_plan import Imported
from .sweep_plan import Sweep


@dataclass(frozen=True)
class Exports:
    """Plan of the exports. Methods with `wildcards` are inputs and parameters of rules."""

    imported: Imported
    sweep: Sweep

    @property
    def targets(self) -> dict[str, paths.Wildcards]:
        """Patterns of the files and folders that this run's configuration asks for, with their wildcards."""
        settings, with_mesh = self.imported.settings, self.imported.with_mesh
        formats = settings.config.exports.mesh_formats
        return {
            paths.EXPORTED_MESH: [{"blade": blade, "format": name} for blade in with_mesh for name in formats],
            paths.EXPORTED_MODES: paths.of("blade", with_mesh),
            paths.EXPORTED_SURFACE: paths.of("blade", self.imported.given_by(BladeDefinition)),
            paths.EXPORTED_MATRICES: paths.of("blade", settings.blades),
            paths.EXPORTED_STRESS: paths.of_runs(self.sweep.runs_with("stress")),
        }

    @property
    def choice(self) -> dict[str, Any]:
        """The section of config.yaml, with the speeds (rad/s) of modes and matrices."""
        settings = self.imported.settings
        given, highest = settings.config.exports, settings.structure.maximum_speed_rad_s
        return {
            "formats": tuple(given.result_formats),
            "modes": given.modes,
            "mode_speeds": si_fields(given).get("mode_speeds", (0.0, highest)),
            "matrix_speeds": (0.0, 0.5 * highest, highest),
            "spin_softening": settings.structure.spin_softening,
        }

    def model(self, wildcards: Any) -> str:
        """The model of the whole blade with the contact nodes of a scene, or else those of config.yaml."""
        settings = self.imported.settings
        scene = getattr(wildcards, "scene", None)
        tip_line = settings.scenes[scene].tip_line if scene else settings.structure.boundary.tip_line
        return paths.fill(paths.WHOLE_BLADE_MODEL, blade=wildcards.blade, tip_line=tip_line)

    def reduction(self, wildcards: Any) -> dict[str, Any]:
        """What the model of the whole blade is made of: the sweep's, recovered everywhere."""
        choice = self.imported.settings.reduction_choice(wildcards.blade, wildcards.tip_line)
        return to_plain(replace(choice, recover_whole_blade=True))

    def orientation(self, wildcards: Any) -> Any:
        """Axes and unit in which results are written: those of an imported mesh, or the blade's own frame."""
        definition = self.imported.settings.blades[wildcards.blade].definition
        return to_plain(definition.orientation if isinstance(definition, MeshSource) else OURS)

    def matrix_files(self, wildcards: Any) -> dict[str, str]:
        """What matrices are written from: the reduced model, and the mesh where full ones are wanted."""
        settings = self.imported.settings
        tip_line = settings.structure.boundary.tip_line
        found = {"rom": paths.fill(paths.REDUCED_MODEL, blade=wildcards.blade, tip_line=tip_line)}
        if settings.config.exports.full_matrices and wildcards.blade in self.imported.with_mesh:
            found |= {"mesh": paths.fill(paths.MESH, blade=wildcards.blade)}
        return found

    def only_worst(self, wildcards: Any) -> bool:
        """Whether the speed with the largest stress is written alone."""
        return self.imported.settings.config.exports.only_worst()

    def speed_files(self, wildcards: Any) -> list[str]:
        """The simulations among which worst instants are looked for."""
        files = self.sweep.speed_files(wildcards)
        chosen = self.imported.settings.config.exports.stress_speeds()
        if chosen is None:
            return files
        wanted = {f"speed_{exact_text(speed)}.npz" for speed in chosen}
        return [file for file in files if Path(file).name in wanted]
