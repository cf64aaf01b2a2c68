"""The plan of whole rotors: which scenes have one, from what, and which files are made of them."""

from r37core.config import Settings
from r37core.contact.scene import Rotor
from r37core.plans import paths
from r37core.plans.sweep_plan import Sweep

ROTOR_OF_RUN = "<results>/{blade}/{scene}/rotor.nc"


def scene_rotors(settings: Settings) -> dict[str, Rotor]:
    """The rotors of the scenes that a whole rotor meets, by the scenes' names."""
    return {name: chosen.scene.rotor for name, chosen in settings.scenes.items() if chosen.scene.rotor is not None}


def rotor_runs(sweep: Sweep) -> list[tuple[str, str]]:
    """Pairs of blade and scene with a rotor."""
    return [(blade, scene) for blade in sweep.settings.blade_names for scene in scene_rotors(sweep.settings)]


def joined_dataset(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The dataset of all rotors."""
    return {"<results>/rotor.nc": [{}] if rotor_runs(sweep) else []}


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The dataset, the table and a figure of each blade and scene."""
    runs = paths.run_keys(rotor_runs(sweep))
    together = {f"<results>/{name}": runs and [{}] for name in ("rotor.nc", "rotors.csv")}
    return together | paths.pictures("rotor_{blade}__{scene}", runs)


def remarks(settings: Settings) -> list[str]:
    """Remarks on scenes whose numbers are those of many blades."""
    return [
        f"scene '{name}': {len(rotor.numbers)} blades on one lining cost as many times a single one; rms, stress and "
        "tables are those of the worst blade (docs/rotor.md)"
        for name, rotor in scene_rotors(settings).items()
    ]
