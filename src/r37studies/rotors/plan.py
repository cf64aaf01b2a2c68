"""The plan of whole rotors: which scenes have one, from what, and which files are made of them."""

from r37core.config import Settings
from r37core.contact.scene import Rotor
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure
from r37core.plans.sweep_plan import Sweep

ROTOR_OF_RUN = "<results>/{blade}/{scene}/rotor.nc"
DATASET, TABLE = "<results>/rotor.nc", "<results>/rotors.csv"


def scene_rotors(settings: Settings) -> dict[str, Rotor]:
    """The rotors of the scenes that a whole rotor meets, by the scenes' names."""
    return {name: chosen.scene.rotor for name, chosen in settings.scenes.items() if chosen.scene.rotor is not None}


def rotor_runs(sweep: Sweep) -> list[tuple[str, str]]:
    """Pairs of blade and scene with a rotor."""
    return [(blade, scene) for blade in sweep.settings.blade_names for scene in scene_rotors(sweep.settings)]


def remarks(settings: Settings) -> list[str]:
    """Remarks on scenes whose numbers are those of many blades."""
    return [
        f"scene '{name}': {len(rotor.numbers)} blades on one lining cost as many times a single one; rms, stress and "
        "tables are those of the worst blade (docs/rotor.md)"
        for name, rotor in scene_rotors(settings).items()
    ]


EXTENSION = Extension(
    name="rotors",
    targets=lambda sweep: dict.fromkeys((DATASET, TABLE), [{}] if rotor_runs(sweep) else []),
    remarks=remarks,
    figures=(
        Figure(
            rule="rotor_figure",
            name="rotor_{blade}__{scene}",
            runs=lambda sweep: paths.run_keys(rotor_runs(sweep)),
            draw="r37studies.rotors.figures.draw_rotor",
            files={"rotor": ROTOR_OF_RUN},
            label="rotor",
            caption="Blade {blade} in scene {scene}, a whole rotor on one lining. Row: speeds at which any of its blades is "
            "dangerous, unknown or sustained above yield. Middle: motion of every blade's leading edge, normal and tangential "
            "together, over speed, and the largest stress of any blade inside the model and of all revolutions (thin); red "
            "crosses: the blade that diverged first. Below: growth of all blades at the speed of the largest motion, and nodal "
            "diameters there.",
        ),
    ),
    closing="r37studies.rotors.dataset.closing",
)
