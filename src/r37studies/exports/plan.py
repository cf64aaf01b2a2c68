"""exports of config.yaml, and their plan: which files, from what, with which numbers."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from r37core.base.plain import to_plain
from r37core.base.speeds import exact_text
from r37core.config import Settings, si_fields
from r37core.config.section import ExtensionSection, LeftOut, Rpm, Section, Unique, left_out, option
from r37core.config.speed_section import word_or_speeds
from r37core.fem.orientation import OURS
from r37core.plans import paths
from r37core.plans.extension import Extension
from r37core.plans.sweep_plan import Sweep
from r37core.rom.reduction_choice import LINEAR

ModeSpeed = Annotated[float, Field(ge=0, le=1e6)]
ChosenSpeeds: Any = word_or_speeds("worst", "all")


class ExportSection(Section):
    """Files of `snakemake exports`."""

    refuse_several = (("stress_speeds_rad_s", "stress_speeds_rpm"),)

    mesh_formats: Unique[Literal["msh", "vtu", "inp"]] = option(
        "Mesh formats; inp is a complete CalculiX/Abaqus deck", ["msh", "vtu", "inp"]
    )
    modes: int = option("Number of modes at each speed", 10, ge=1, le=30)
    mode_speeds_rad_s: Annotated[Unique[ModeSpeed], Field()] | LeftOut = left_out(
        "Speeds of the modes; by default rest and structure.maximum_speed_rad_s"
    )
    stress_speeds_rad_s: ChosenSpeeds = option(
        "Speeds whose worst instant is written; worst: that of the largest stress of each blade and scene", "worst"
    )
    stress_speeds_rpm: Unique[Rpm] | LeftOut = left_out("The same speeds in revolutions per minute")
    full_matrices: bool = option("Whether matrices of all nodes (hundreds of MB) replace the reduced ones", False)

    def stress_speeds(self) -> tuple[float, ...] | None:
        """Speeds (rad/s) that are named; None for `worst` and `all`."""
        return si_fields(self).get("stress_speeds")


SECTION = ExtensionSection("exports", ExportSection, ExportSection())


EXPORTED_MESH = "<results>/exports/{blade}/mesh.{format}"
EXPORTED_SURFACE = "<results>/exports/{blade}/surface.step"
EXPORTED_MODES = "<results>/exports/{blade}/modes"
EXPORTED_STRESS = "<results>/exports/{blade}/stress_{scene}"
EXPORTED_MATRICES = "<results>/exports/{blade}/matrices"


@dataclass(frozen=True)
class Exports:
    """Plan of the exports. Methods with `wildcards` are inputs and parameters of rules."""

    sweep: Sweep

    @property
    def _section(self) -> ExportSection:
        return self.sweep.settings.section(SECTION)

    @property
    def choice(self) -> dict[str, Any]:
        """The section of config.yaml, with the speeds (rad/s) of modes and matrices."""
        exported, highest = self._section, self.sweep.settings.structure.maximum_speed_rad_s
        return {
            "modes": exported.modes,
            "mode_speeds": si_fields(exported).get("mode_speeds", (0.0, highest)),
            "matrix_speeds": (0.0, 0.5 * highest, highest),
        }

    def orientation(self, wildcards: Any) -> Any:
        """Axes and unit in which results are written: those of an imported mesh, or the blade's own frame."""
        definition = self.sweep.settings.blades[wildcards.blade].definition
        return to_plain(getattr(definition, "orientation", OURS))

    def matrix_files(self, wildcards: Any) -> dict[str, str]:
        """Files that matrices are written from: the reduced model, and the mesh where full ones are wanted."""
        tip_line = self.sweep.settings.structure.boundary.tip_line
        files = {"rom": paths.REDUCED_MODEL.format(blade=wildcards.blade, tip_line=tip_line)}
        if self._section.full_matrices and wildcards.blade in self.sweep.meshed_blades:
            files |= {"mesh": paths.MESH.format(blade=wildcards.blade)}
        return files

    def only_worst(self, wildcards: Any) -> bool:
        """True where the speed with the largest stress is written alone."""
        return self._section.stress_speeds() is None and self._section.stress_speeds_rad_s == "worst"

    def speed_files(self, wildcards: Any) -> list[str]:
        """The simulations among which worst instants are looked for."""
        files = self.sweep.speed_files(wildcards)
        chosen = self._section.stress_speeds()
        if chosen is None:
            return files
        wanted = {f"speed_{exact_text(speed)}.npz" for speed in chosen}
        return [file for file in files if Path(file).name in wanted]


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """Files and folders that this run's configuration asks for."""
    meshed, formats = sweep.meshed_blades, sweep.settings.section(SECTION).mesh_formats
    return {
        EXPORTED_MESH: [{"blade": blade, "format": name} for blade in meshed for name in formats],
        EXPORTED_MODES: paths.of("blade", meshed),
        EXPORTED_SURFACE: paths.of("blade", sweep.made_by("geometry")),
        EXPORTED_MATRICES: paths.of("blade", sweep.settings.blades),
        EXPORTED_STRESS: paths.run_keys(sweep.runs_with("stress")),
    }


def exported_speeds_are_run(settings: Settings) -> None:
    """Speeds of `exports` are simulated whatever is found, and within the reduced model's basis."""
    exported, highest, document = settings.section(SECTION), settings.structure.maximum_speed_rad_s, settings.document
    run = {speed for plan in settings.speed_plans.values() for speed in plan.certain}
    key = "stress_speeds_rad_s" if exported.stress_speeds_rpm is None else "stress_speeds_rpm"
    allowed = "speeds that are simulated whatever a range refines to; name it under speeds, too"
    for number, speed in enumerate(exported.stress_speeds() or []):
        if speed not in run:
            raise document.refusal(f"{getattr(exported, key)[number]:g}", allowed, "exports", key, number)
    for number, speed in enumerate(exported.mode_speeds_rad_s or []):
        if speed > highest:
            allowed = f"up to structure.maximum_speed_rad_s, {highest:g}"
            raise document.refusal(f"{speed:g}", allowed, "exports", "mode_speeds_rad_s", number)


def full_matrices_are_linear(settings: Settings) -> None:
    """Matrices of all nodes are those of small displacements: of the others there is none that is right at every speed."""
    others = [name for name in settings.blades if settings.kinematics_of(name) != LINEAR]
    if settings.section(SECTION).full_matrices and others:
        value = f"true with the blade '{others[0]}' of kinematics {settings.kinematics_of(others[0])}"
        raise settings.document.refusal(value, f"false, or structure.kinematics: {LINEAR}", "exports", "full_matrices")


EXTENSION = Extension(
    name="exports",
    section=SECTION,
    checks=(exported_speeds_are_run, full_matrices_are_linear),
    targets=targets,
    look_at="<results>/exports",
    made_on_request=True,
)
