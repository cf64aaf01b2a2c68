"""What makes an interval of speeds worth halving. Light: the configuration imports it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from r37core.declared import Key
from r37core.rom.naming import NAMED_MODES


@dataclass(frozen=True)
class Window:
    """Where an interaction is expected: from `first` to `last`, shares of the speed above the crossings of `mode`.

    Its intervals are halved until none is longer than `step` (rad/s), before anything is known.
    """

    mode: Annotated[str, Key("whose crossings", one_of=NAMED_MODES)]
    highest_engine_order: Annotated[int, Key("from order 1 up to this one", ge=1, le=100)]
    first: Annotated[float, Key("where it begins, as a share of the crossing's speed above it", ge=-0.5, le=1)]
    last: Annotated[float, Key("where it ends", ge=-0.5, le=1)]
    step: Annotated[float, Key("its intervals are halved until none is longer", "_rad_s", ge=1e-3, le=1e6)]


@dataclass(frozen=True)
class RefinementChoice:
    """What makes an interval of speeds worth halving; every number is a share.

    `windows` come first. Then an interval is halved when rms or stress change by more than `change` of the larger, when
    stress crosses yield, when the status changes, and when a peak of at least `prominence` of the largest reaches within
    `peak` of its height in it; changes below `prominence` of the largest do not count. A change by more than `steep_change`
    counts down to `steep_prominence`: an interaction narrower than the interval leaves no more than its foot. At most
    `largest_share` of the grid is run, where the response is largest first.
    """

    windows: tuple[Window, ...]
    prominence: float
    change: Annotated[
        float, Key("an interval is halved when rms or stress change by more, as a share of the larger", ge=1e-3, le=10)
    ] = 0.25
    peak: Annotated[float, Key("intervals are halved that reach so close to a peak's height, as a share of it", ge=0, lt=1)] = (
        0.1
    )
    steep_change: Annotated[
        float,
        Key(
            "a change by more is the foot of an interaction narrower than the interval: it is halved down to "
            "steep_prominence; 1: never",
            ge=1e-3,
            le=1,
        ),
    ] = 0.8
    steep_prominence: Annotated[
        float, Key("height from which a steep change counts, as a share of the largest", ge=1e-6, le=1)
    ] = 0.01
    largest_share: Annotated[
        float, Key("of the finest grid that is run at most; where the response is largest goes first", ge=1e-3, le=1)
    ] = 0.2
