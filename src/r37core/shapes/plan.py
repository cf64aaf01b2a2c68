"""shapes of config.yaml, and their plan: which blades and scenes have them, and which files are made."""

from dataclasses import dataclass
from typing import Any

from pydantic import Field

from r37core.config.section import ExtensionSection, Section
from r37core.exchange.importing.source import MeshSource
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure
from r37core.plans.structure_plan import Imported
from r37core.plans.sweep_plan import Sweep


class ShapeSection(Section):
    """Modes and worst instants as files that move."""

    modes: int = Field(default=6, ge=1, le=30, description="Number of modes of each blade, at rest")
    imported: bool = Field(default=True, description="Modes of imported meshes also without a scene that asks for shapes")


SECTION = ExtensionSection("shapes", ShapeSection, ShapeSection())

MODE_SHAPES = "<results>/shapes/{blade}/modes"
WORST_SHAPES = "<results>/shapes/{blade}/stress_{scene}"
PAGE = "<results>/shapes/{blade}.html"


@dataclass(frozen=True)
class Shapes:
    """Plan of the shapes that scenes ask for. Methods with `wildcards` are inputs and parameters of rules."""

    sweep: Sweep

    @property
    def runs(self) -> list[tuple[str, str]]:
        """Pairs of blade and scene with shapes."""
        return self.sweep.runs_with("shapes")

    @property
    def blades(self) -> list[str]:
        """Blades with modes: those of the runs, and meshes of other programs."""
        meshes = Imported(self.sweep.settings).given_by(MeshSource) if self.sweep.settings.section(SECTION).imported else []
        wanted = {*meshes, *(blade for blade, _ in self.runs)}
        return [blade for blade in self.sweep.settings.blades if blade in wanted]

    def scenes(self, wildcards: Any) -> list[str]:
        """Scenes of a blade with shapes."""
        return [scene for blade, scene in self.runs if blade == wildcards.blade]

    def worst_shapes(self, wildcards: Any) -> list[str]:
        """The shapes of interactions of a blade, in each of its scenes that asks for them."""
        return [paths.fill(WORST_SHAPES, blade=wildcards.blade, scene=scene) for scene in self.scenes(wildcards)]


def _runs(sweep: Sweep) -> paths.Wildcards:
    return paths.run_keys(Shapes(sweep).runs)


def _blades(sweep: Sweep) -> paths.Wildcards:
    return paths.of("blade", Shapes(sweep).blades)


EXTENSION = Extension(
    name="shapes",
    section=SECTION,
    targets=lambda sweep: {MODE_SHAPES: _blades(sweep), WORST_SHAPES: _runs(sweep), PAGE: _blades(sweep)},
    figures=(
        Figure(
            rule="modes_figure",
            name="shapes_{blade}",
            runs=_blades,
            draw="shapes.stills.draw_shapes",
            files={"folder": MODE_SHAPES},
            label="first modes",
            caption="The first modes of blade {blade} at rest, each moved by its shape from the blade as it is (black "
            "outline). Colours above: displacement as a share of its largest; below: von Mises stress for 1 mm of it. The "
            "page of the blade's shapes moves them.",
        ),
        Figure(
            rule="worst_shapes_figure",
            name="shapes_{blade}__{scene}",
            runs=_runs,
            draw="shapes.stills.draw_shapes",
            files={"folder": WORST_SHAPES},
            label="worst instants",
            caption="Blade {blade} in scene {scene} at the worst instant of each interaction, displaced as the title says "
            "(black outline: as it is). Colours are the von Mises stress, each on a scale of its own.",
        ),
    ),
)
