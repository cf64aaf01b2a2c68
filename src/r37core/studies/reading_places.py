"""Where a reading is run: blades, scenes and speeds. Light: the workflow imports it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil, floor

from r37core.published import DIRECT_PEAK, INTERACTIONS, QUIET, REFERENCE, Interaction

from .reading_list import Reading

FINE_WINDOW = (0.0, 0.05)
"""About an interaction, in shares of the published Campbell speed."""

COARSE_WINDOW = (-0.012, 0.016)
"""About an interaction, in shares of the published peak speed."""

DIRECT_WINDOW = (-20.0, 28.0)
"""About direct contact's published largest rms (rad/s)."""

ELSEWHERE = (850.0, 1000.0, 1100.0, 1200.0, 1300.0, 1400.0, 1500.0, 1600.0, 1717.0, 1800.0, 1900.0)
"""Speeds (rad/s) of direct contact beside its window."""

WHOLE_RANGE = (750.0, 2000.0)
DIRECT = "Ref_direct"


@dataclass(frozen=True)
class Place:
    """One job: a blade in one kind of scene (lined or direct) at some speeds (rad/s, ascending).

    `histories`: speeds whose stress is kept for every revolution; `follow`: go on beyond the window while its ends are above
    yield, and keep the history of the peak; `spectrum`: keep the spectra.
    """

    blade: str
    kind: str
    speeds: tuple[float, ...]
    histories: tuple[float, ...] = ()
    follow: bool = False
    spectrum: bool = False


def places(reading: Reading, steps: Mapping[str, float]) -> dict[str, Place]:
    """All jobs of a reading by name; `steps` (rad/s): of the grids `fine`, `coarse` and `survey`."""
    if reading.surveys:
        return _surveys(steps["survey"])
    found = {
        one.name: _interaction(one, reading.fine, steps)
        for one in INTERACTIONS
        if reading.blades is None or one.blade in reading.blades
    }
    if not reading.only_lining:
        found[DIRECT] = _direct(reading.fine, steps)
    return found


def _interaction(one: Interaction, fine: bool, steps: Mapping[str, float]) -> Place:
    speeds = _window(one.campbell, FINE_WINDOW, steps["fine"]) if fine else _window(one.peak, COARSE_WINDOW, steps["coarse"])
    histories: tuple[float, ...] = ()
    if one.engine_order == 4 and one.blade == REFERENCE:
        histories = (one.peak, DIRECT_PEAK, QUIET)
    return Place(one.blade, "lined", speeds, histories, follow=fine)


def _direct(fine: bool, steps: Mapping[str, float]) -> Place:
    window = grid(DIRECT_PEAK, *DIRECT_WINDOW, steps["fine" if fine else "coarse"])
    others = {*ELSEWHERE, DIRECT_PEAK + 1.0} if fine else {*ELSEWHERE}
    reference = INTERACTIONS[0].peak
    return Place(REFERENCE, "direct", tuple(sorted({*window, *others})), (DIRECT_PEAK, reference, QUIET), follow=False)


def _surveys(step: float) -> dict[str, Place]:
    low, high = WHOLE_RANGE
    every, every_other = grid(low, 0.0, high - low, step), grid(low, 0.0, high - low, 2.0 * step)
    return {
        "Ref_lined": Place(REFERENCE, "lined", every, spectrum=True),
        "Ref_direct": Place(REFERENCE, "direct", every_other, spectrum=True),
        "CS100_lined": Place("CS100", "lined", every, spectrum=True),
    }


def _window(centre: float, shares: tuple[float, float], step: float) -> tuple[float, ...]:
    return grid(centre, shares[0] * centre, shares[1] * centre, step)


def grid(centre: float, below: float, above: float, step: float) -> tuple[float, ...]:
    """Multiples of `step` about `centre`, from `below` to `above` it."""
    first, last = ceil(below / step - 1e-9), floor(above / step + 1e-9)
    return tuple(centre + number * step for number in range(first, last + 1))
