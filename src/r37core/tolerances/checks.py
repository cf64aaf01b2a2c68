"""What the section of tolerances alone cannot check."""

from __future__ import annotations

from r37core.config import Settings
from r37core.config.cross_checks import LARGEST_NUMBER_OF_SIMULATIONS, names_are_there

from .members import members_of
from .section import SECTION


def members_can_be_drawn(settings: Settings) -> None:
    """Tolerances name blades, scenes and numbers that are there, no member is impossible, and all can be planned."""
    entry, documents, path = settings.section(SECTION), settings.documents, ("tolerances",)
    names_are_there(settings, path, entry)
    # the configuration that a run keeps has the empty section written out
    if entry != type(entry)() and not members_of(settings).numbers:
        raise documents.config.refusal(path, "no numbers", "some under of_scenes or of_blades")
    members = entry.members * (len(members_of(settings).numbers) + 2 if entry.sensitivity else 1)
    number = members * sum(len(settings.speed_plans[pair].certain) for pair in members_of(settings).pairs)
    if number > LARGEST_NUMBER_OF_SIMULATIONS:
        raise documents.config.refusal(
            (*path, "members"),
            f"{number} simulations of members",
            f"at most {LARGEST_NUMBER_OF_SIMULATIONS} in one run: fewer members, speeds, blades or scenes, or no sensitivity",
        )
    # draws them, and refuses what is impossible
    _ = members_of(settings).all
