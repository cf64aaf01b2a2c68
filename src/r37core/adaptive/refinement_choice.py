"""Choice of what makes an interval of speeds worth halving. Light: the configuration imports it."""

from dataclasses import dataclass
from typing import Annotated

from r37core.base.declared import Key
from r37core.rom.naming import NAMED_MODES


@dataclass(frozen=True)
class Window:
    """Window in which an interaction is expected: from `first` to `last`, shares of the speed above the crossings of `mode`.

    Its intervals are halved until none is longer than `step` (rad/s), before anything is known.
    """

    mode: Annotated[str, Key("Mode whose crossings have a window", one_of=NAMED_MODES)]
    highest_engine_order: Annotated[int, Key("Highest engine order with a window", ge=1, le=100)]
    first: Annotated[float, Key("Start of a window, as a share of the crossing's speed above it", ge=-0.5, le=1)]
    last: Annotated[float, Key("End of a window, as first", ge=-0.5, le=1)]
    step: Annotated[float, Key("Longest interval in a window", "_rad_s", ge=1e-3, le=1e6)]


@dataclass(frozen=True)
class RefinementChoice:
    """Choice of what makes an interval of speeds worth halving; every number is a share.

    `windows` come first. Then an interval is halved when one of its speeds is dangerous or unknown and the other is not so;
    when rms or stress inside the model change by more than `change` of the larger; and when a peak of at least `prominence` of
    the largest reaches within `peak` of its height in it. Changes below `prominence` of the largest do not count. A change by
    more than `steep_change` counts down to `steep_prominence`: an interaction narrower than the interval leaves no more than
    its foot. At most `largest_share` of the grid is run, where the response is largest first.
    """

    windows: tuple[Window, ...]
    prominence: float
    change: Annotated[float, Key("Relative change of rms or stress above which an interval is halved", ge=1e-3, le=10)] = 0.25
    peak: Annotated[float, Key("Share of a peak's height within which intervals are halved", ge=0, lt=1)] = 0.1
    steep_change: Annotated[
        float, Key("Relative change that marks an interaction narrower than the interval; 1 switches this off", ge=1e-3, le=1)
    ] = 0.8
    steep_prominence: Annotated[
        float, Key("Smallest height of a steep change, as a share of the largest response", ge=1e-6, le=1)
    ] = 0.01
    largest_share: Annotated[
        float, Key("Largest share of the finest grid that is run; large responses come first", ge=1e-3, le=1)
    ] = 0.2
