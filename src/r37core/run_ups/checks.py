"""Checks of run-ups that need more than their section."""

import math

from r37core.base.yaml_file import KeyPath
from r37core.config import Settings, scenes_named
from r37core.config.cross_checks import engine_order_is_known, names_are_there, slow_run_can_be_done
from r37core.config.document import ConfigRefusals
from r37core.config.speed_choice import length_of_run

from .choice import RunUpError, check_highest
from .section import SECTION, RunUpEntry


def run_ups_can_be_done(settings: Settings) -> None:
    """Run-ups name blades, scenes and orders that are there, wear a lining, and change little from sample to sample."""
    refusals = ConfigRefusals()
    for name, entry in settings.section(SECTION).items():
        refusals.of(_can_be_done, settings, name, entry)
    refusals.tell()


def _can_be_done(settings: Settings, name: str, entry: RunUpEntry) -> None:
    path: KeyPath = ("run_ups", name)
    names_are_there(settings, path, entry)
    per_revolution, document = settings.fidelity.time_integration.samples_per_revolution, settings.documents.config
    choice, highest = entry.choice(1), settings.structure.maximum_speed_rad_s
    try:
        # of a crossing what holds wherever it lies: the higher, the more revolutions
        choice.run_up(per_revolution, highest if entry.crossing else None)
        if entry.crossing is None:
            check_highest(max(choice.start, choice.stop), highest)
    except RunUpError as error:
        raise document.error((*path, entry.key_of_length), str(error)) from None
    if entry.crossing:
        engine_order_is_known(settings, (*path, "crossing", "engine_order"), entry.crossing.engine_order)
    for scene in scenes_named(settings, entry.scenes):
        if entry.lining == "worn" and settings.scene_designs.entries[scene].lining is None:
            lining = f"worn in the scene '{scene}', which has no lining"
            raise document.refusal((*path, "lining"), lining, "new, or scenes with a lining")


def slowest_speeds_can_be_run(settings: Settings) -> None:
    """Neither the run-up nor a revolution at its slowest speed, whose steps all have, has too many steps."""
    for name, entry in settings.section(SECTION).items():
        if entry.crossing is not None:
            continue
        choice = entry.choice(settings.fidelity.time_integration.revolutions)
        squares, changing = abs(choice.stop**2 - choice.start**2), choice.revolutions or 0.0
        if choice.rate is not None:
            changing = squares / (4.0 * math.pi * choice.rate)
        for scene in settings.scenes:
            revolutions = choice.before + changing + choice.after
            run = length_of_run(settings, scene, min(choice.start, choice.stop), revolutions)
            slow_run_can_be_done(run, settings, ("run_ups", name))


def no_rotors(settings: Settings) -> None:
    """Run-ups are wanted of single blades."""
    rotors = [name for name, chosen in settings.scenes.items() if chosen.scene.rotor is not None]
    for name, entry in settings.section(SECTION).items():
        for scene in [scene for scene in scenes_named(settings, entry.scenes) if scene in rotors]:
            raise settings.documents.config.refusal(
                ("run_ups", name, "scenes"),
                f"'{scene}', which has a rotor",
                "scenes of a single blade; the speed of a rotor does not change while it runs",
            )


def no_coriolis(settings: Settings) -> None:
    """The Coriolis force is wanted of runs at constant speed alone."""
    for name in settings.section(SECTION) if settings.structure.coriolis else ():
        raise settings.documents.config.refusal(
            ("run_ups", name), "a run-up with structure.coriolis: true", "none; run-ups do not carry the Coriolis force yet"
        )
