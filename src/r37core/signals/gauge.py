"""Where a strain gauge is, and which way it looks. Light: the configuration imports it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from r37core.declared import Key


@dataclass(frozen=True)
class Gauge:
    """A strain gauge on the blade's surface. `angle` (rad): pi/2 towards the trailing edge."""

    chord: Annotated[float, Key("place along the chord, from the leading (0) to the trailing edge (1)", ge=0, le=1)]
    span: Annotated[float, Key("place along the span, from the root (0) to the tip (1)", ge=0, le=1)]
    side: Annotated[str, Key("of the blade's surface", one_of=("pressure", "suction"))]
    angle: Annotated[
        float, Key("direction in the surface: 0 along the span, 90 towards the trailing edge", "_deg", ge=-180, le=180)
    ] = 0.0
