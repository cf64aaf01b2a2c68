"""Limits by which peaks count as interactions. Light: the configuration imports it."""

from dataclasses import dataclass
from typing import Annotated

from r37core.base.declared import Key


@dataclass(frozen=True)
class InteractionChoice:
    """Limits by which peaks count as interactions.

    A peak of the leading edge's normal or tangential rms must rise above its surroundings, on both sides, by `prominence` of
    the largest one in that direction. It is matched with a crossing of the engine order that is strongest in that
    direction's spectrum if it lies between `below` and `above` (shares of the Campbell speed) about it; without a spectrum,
    with the nearest crossing of any order.
    """

    prominence: Annotated[float, Key("Rise of a peak above its surroundings, as a share of the largest", ge=1e-6, le=1)] = 0.1
    below: Annotated[float, Key("Largest distance of a peak below its Campbell speed, as a share", ge=0, le=0.5)] = 0.02
    above: Annotated[float, Key("Largest distance of a peak above its Campbell speed, as a share", ge=0, le=1)] = 0.06

    @property
    def span(self) -> float:
        """Largest ratio of two speeds that the crossing of one mode and order could explain."""
        return (1.0 + self.above) / (1.0 - self.below)
