"""The plan of `snakemake exports`: which files, from what, with which numbers."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from r37core.blade.definition import BladeDefinition
from r37core.config import si_fields
from r37core.exchange.importing.source import MeshSource
from r37core.exchange.orientation import OURS
from r37core.plain import to_plain
from r37core.plans import paths
from r37core.plans.structure_plan import Imported
from r37core.plans.sweep_plan import Sweep
from r37core.speeds import exact_text

from .section import SECTION

EXPORTED_MESH = "<results>/exports/{blade}/mesh.{format}"
EXPORTED_SURFACE = "<results>/exports/{blade}/surface.step"
EXPORTED_MODES = "<results>/exports/{blade}/modes"
EXPORTED_STRESS = "<results>/exports/{blade}/stress_{scene}"
EXPORTED_MATRICES = "<results>/exports/{blade}/matrices"


@dataclass(frozen=True)
class Exports:
    """Plan of the exports. Methods with `wildcards` are inputs and parameters of rules."""

    imported: Imported
    sweep: Sweep

    @property
    def choice(self) -> dict[str, Any]:
        """The section of config.yaml, with the speeds (rad/s) of modes and matrices."""
        settings = self.imported.settings
        exported, highest = settings.section(SECTION), settings.structure.maximum_speed_rad_s
        return {
            "formats": tuple(exported.result_formats),
            "modes": exported.modes,
            "mode_speeds": si_fields(exported).get("mode_speeds", (0.0, highest)),
            "matrix_speeds": (0.0, 0.5 * highest, highest),
        }

    def orientation(self, wildcards: Any) -> Any:
        """Axes and unit in which results are written: those of an imported mesh, or the blade's own frame."""
        definition = self.imported.settings.blades[wildcards.blade].definition
        return to_plain(definition.orientation if isinstance(definition, MeshSource) else OURS)

    def matrix_files(self, wildcards: Any) -> dict[str, str]:
        """What matrices are written from: the reduced model, and the mesh where full ones are wanted."""
        settings = self.imported.settings
        tip_line = settings.structure.boundary.tip_line
        files = {"rom": paths.fill(paths.REDUCED_MODEL, blade=wildcards.blade, tip_line=tip_line)}
        if settings.section(SECTION).full_matrices and wildcards.blade in self.imported.meshed_blades:
            files |= {"mesh": paths.fill(paths.MESH, blade=wildcards.blade)}
        return files

    def only_worst(self, wildcards: Any) -> bool:
        """Whether the speed with the largest stress is written alone."""
        return self.imported.settings.section(SECTION).only_worst()

    def speed_files(self, wildcards: Any) -> list[str]:
        """The simulations among which worst instants are looked for."""
        files = self.sweep.speed_files(wildcards)
        chosen = self.imported.settings.section(SECTION).stress_speeds()
        if chosen is None:
            return files
        wanted = {f"speed_{exact_text(speed)}.npz" for speed in chosen}
        return [file for file in files if Path(file).name in wanted]


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """Files and folders that this run's configuration asks for."""
    settings = sweep.settings
    imported, formats = Imported(settings), settings.section(SECTION).mesh_formats
    return {
        EXPORTED_MESH: [{"blade": blade, "format": name} for blade in imported.meshed_blades for name in formats],
        EXPORTED_MODES: paths.of("blade", imported.meshed_blades),
        EXPORTED_SURFACE: paths.of("blade", imported.given_by(BladeDefinition)),
        EXPORTED_MATRICES: paths.of("blade", settings.blades),
        EXPORTED_STRESS: paths.run_keys(sweep.runs_with("stress")),
    }
