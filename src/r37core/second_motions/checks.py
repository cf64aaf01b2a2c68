"""Checks of the second motions that need more than their section."""

from r37core.base.yaml_file import KeyPath
from r37core.config import Settings, scenes_named
from r37core.config.cross_checks import names_are_there, slow_run_can_be_done
from r37core.config.document import ConfigRefusals
from r37core.config.speed_choice import length_of_run

from .section import SECTION, pairs_of

MOST_SPEEDS = 20_000
"""Speeds of a sweep: one job runs all of them."""


def can_be_swept(settings: Settings) -> None:
    """Blades and scenes are there, without rotor or Coriolis force, and the speeds within the model's and not too many."""
    section, document = settings.section(SECTION), settings.documents.config
    if not section.asked:
        return
    names_are_there(settings, ("second_motions",), section)
    sweep, path, refusals = section.sweep(), ("second_motions",), ConfigRefusals()
    if settings.structure.coriolis:
        raise document.refusal(path, "sweeps with structure.coriolis: true", "none; they do not carry the Coriolis force yet")
    for scene in [] if section.scenes == "all" else scenes_named(settings, section.scenes):
        entry = settings.scene_designs.entries[scene]
        if entry.rotor is not None:
            raise document.refusal((*path, "scenes"), f"'{scene}', which has a rotor", "scenes of a single blade")
    count = (sweep.last - sweep.first) / sweep.step + 1.0
    if count > MOST_SPEEDS:
        raise document.refusal(path, f"{count:.8g} speeds", f"at most {MOST_SPEEDS}; a larger step has fewer")
    highest = settings.structure.maximum_speed_rad_s
    last_key: KeyPath = ("to_rad_s" if section.to_rpm is None else "to_rpm",)
    dwelt = [(("dwell", "speeds_rad_s", number), speed) for number, speed in enumerate(section.dwell.speeds_rad_s)]
    for key, speed in [(last_key, sweep.speeds[-1]), *dwelt]:
        if speed > highest:
            raise document.refusal((*path, *key), f"{speed:g} rad/s", f"up to structure.maximum_speed_rad_s, {highest:g}")
    for _, scene in pairs_of(settings):
        if sweep.worn and section.scenes != "all" and settings.scenes[scene].scene.lining is None:
            raise document.refusal((*path, "lining"), f"worn in the scene '{scene}', which has no lining", "new")
        longest = max(sweep.revolutions, section.dwell.revolutions, settings.scenes[scene].revolutions)
        slowest = min([sweep.first, *section.dwell.speeds_rad_s])
        refusals.of(slow_run_can_be_done, length_of_run(settings, scene, slowest, longest), settings, path)
    refusals.tell()
