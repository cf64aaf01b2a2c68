"""Checks of requirements that need more than their section."""

from r37core.config import Settings, operating_range
from r37core.config.cross_checks import engine_order_is_known, pairs_not_covered
from r37core.rom.naming import mode_names

from .section import SECTION


def can_be_judged(settings: Settings) -> None:
    """Requirements have an operating range, and their crossings are in the Campbell diagram."""
    requirements, document = settings.section(SECTION).requirements(), settings.documents.config
    if not requirements.any:
        return
    operating = operating_range(settings)
    if operating is None:
        raise document.refusal(
            ("requirements",), "requirements without operating", "operating: with idle and redline beside them"
        )
    modes = mode_names(settings.config.campbell.modes)
    asked: set[tuple[str, int]] = set()
    for number, margin in enumerate(requirements.campbell_margins):
        place = ("requirements", "campbell_margins", number)
        if margin.mode not in modes:
            raise document.refusal((*place, "mode"), f"'{margin.mode}'", ", ".join(modes))
        if not margin.engine_orders:
            raise document.refusal((*place, "engine_orders"), "none", "one or more engine orders")
        engine_order_is_known(settings, (*place, "engine_orders"), max(margin.engine_orders))
        for order in margin.engine_orders:
            if (margin.mode, order) in asked:
                raise document.refusal((*place, "engine_orders"), f"{order} of {margin.mode} twice", "each once")
            asked.add((margin.mode, order))
        # a crossing above the diagram is not known, and may be too near
        needed = max([dwell.stop for dwell in operating.dwell] or [operating.last]) / (1.0 - min(margin.least, 0.99))
        if settings.structure.maximum_speed_rad_s < needed:
            reach = f"{100.0 * margin.least:g}, for which crossings up to {needed:.6g} rad/s count"
            allowed = (
                f"a margin within structure.maximum_speed_rad_s ({settings.structure.maximum_speed_rad_s:g}), or that larger"
            )
            raise document.refusal((*place, "at_least_percent"), reach, allowed)


def remarks(settings: Settings) -> list[str]:
    """Which blades and scenes are not run over the whole operating range, whose verdict is not known."""
    operating = operating_range(settings)
    if operating is None:
        return []
    if not (short := pairs_not_covered(settings, operating)):
        return []
    named = ", ".join(f"{blade} in {scene}" for blade, scene in short[:3]) + (", ..." if len(short) > 3 else "")
    reach = f"{operating.first:.6g} to {operating.last:.6g} rad/s"
    return [f"operating: the speeds of {named} do not reach over {reach}; what is judged there is not known"]
