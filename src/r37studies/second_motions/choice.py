"""Numbers of the sweeps."""

from dataclasses import dataclass
from typing import Annotated

from r37core.base.declared import Key, speed_keys
from r37core.base.speeds import spaced

MOTIONS = UP, DOWN, REST = ("up", "down", "rest")
"""Motions at a speed: carried up from lower speeds, carried down from higher ones, and from rest as the pipeline runs it."""

STEP = 5.0
"""Step between the speeds (rad/s) unless one is given."""

FEWEST_REVOLUTIONS = 10
"""Fewest revolutions of a speed: their scatter decides whether motions differ."""


@dataclass(frozen=True)
class SweepChoice:
    """Speeds (rad/s) from `first` to `last`, in steps, and what is carried from one to the next.

    `worn`: whether the lining is carried on as it is worn, or new at each speed.
    """

    first: Annotated[float, speed_keys("Lowest speed", "from")]
    last: Annotated[float, speed_keys("Highest speed, if the step reaches it", "to")]
    step: Annotated[
        float,
        Key("Step between the speeds; by default 5 rad/s", "_rad_s", ge=1e-3, le=1e4, optional=True),
        Key("The same step in revolutions per minute", "_rpm", ge=0.01, le=1e5, optional=True),
    ]
    revolutions: Annotated[
        int | None, Key("Revolutions at each speed; by default those of the runs from rest", ge=FEWEST_REVOLUTIONS, le=20000)
    ] = None
    worn: Annotated[
        bool, Key("Lining at each speed: new, or worn by the speeds before", name="lining", words={"new": False, "worn": True})
    ] = False

    @property
    def speeds(self) -> list[float]:
        """All speeds (rad/s), ascending."""
        return spaced(self.first, self.last, self.step)
