"""Files for other programs as an extension."""

from __future__ import annotations

from r37core.config import Settings
from r37core.plans.extension import Extension

from .plan import SECTION, targets


def exported_speeds_are_run(settings: Settings) -> None:
    """Speeds of `exports` are simulated whatever is found, and within the reduced model's basis."""
    exported, highest, document = settings.section(SECTION), settings.structure.maximum_speed_rad_s, settings.documents.config
    run = {speed for plan in settings.speed_plans.values() for speed in plan.certain}
    key = "stress_speeds_rad_s" if exported.stress_speeds_rpm is None else "stress_speeds_rpm"
    allowed = "speeds that are simulated whatever a range refines to; name it under speeds, too"
    for number, speed in enumerate(exported.stress_speeds() or []):
        if speed not in run:
            raise document.refusal(("exports", key, number), f"{getattr(exported, key)[number]:g}", allowed)
    for number, speed in enumerate(exported.mode_speeds_rad_s or []):
        if speed > highest:
            allowed = f"up to structure.maximum_speed_rad_s, {highest:g}"
            raise document.refusal(("exports", "mode_speeds_rad_s", number), f"{speed:g}", allowed)


EXTENSION = Extension(
    name="exports",
    section=SECTION,
    checks=(exported_speeds_are_run,),
    targets=targets,
    look_at="<results>/exports",
    made_on_request=True,
)
