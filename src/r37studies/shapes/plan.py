"""shapes of config.yaml, and their plan: which blades and scenes have them, and which files are made."""

from r37core.config.section import ExtensionSection, Section, option
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure
from r37core.plans.sweep_plan import Sweep


class ShapeSection(Section):
    """Pictures of modes and of the worst instants of interactions."""

    modes: int = option("Number of modes of each blade, at rest", 6, ge=1, le=30)
    imported: bool = option("Modes of imported meshes also without a scene that asks for shapes", False)


SECTION = ExtensionSection("shapes", ShapeSection, ShapeSection())

MODE_SHAPES = "<results>/shapes/{blade}/modes"
WORST_SHAPES = "<results>/shapes/{blade}/stress_{scene}"


def _runs(sweep: Sweep) -> paths.Wildcards:
    """Blades and scenes with worst instants."""
    return paths.run_keys(sweep.runs_with("shapes"))


def _blades(sweep: Sweep) -> paths.Wildcards:
    """Blades with modes: those of the runs, and meshes of other programs."""
    meshes = sweep.made_by("imported_mesh") if sweep.settings.section(SECTION).imported else []
    wanted = {*meshes, *(blade for blade, _ in sweep.runs_with("shapes"))}
    return paths.of("blade", [blade for blade in sweep.settings.blades if blade in wanted])


EXTENSION = Extension(
    name="shapes",
    section=SECTION,
    targets=lambda sweep: {MODE_SHAPES: _blades(sweep), WORST_SHAPES: _runs(sweep)},
    figures=(
        Figure(
            rule="modes_figure",
            name="shapes_{blade}",
            runs=_blades,
            draw="r37studies.shapes.stills.draw_modes",
            over_speed=False,
            files={"folder": MODE_SHAPES},
            label="first modes",
            caption="The first modes of blade {blade} at rest, each moved by its shape from the blade as it is (black "
            "outline). Colours above: displacement as a share of its largest; below: von Mises stress for 1 mm of it.",
        ),
        Figure(
            rule="worst_shapes_figure",
            name="shapes_{blade}__{scene}",
            runs=_runs,
            draw="r37studies.shapes.stills.draw_worst_instants",
            over_speed=False,
            files={"folder": WORST_SHAPES},
            label="worst instants",
            caption="Blade {blade} in scene {scene} at the worst instant of each interaction, displaced as the title says "
            "(black outline: as it is). Colours are the von Mises stress, each on a scale of its own.",
        ),
    ),
)
