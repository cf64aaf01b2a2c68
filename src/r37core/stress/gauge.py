"""Place and direction of a strain gauge. Light: the configuration imports it."""

from dataclasses import dataclass
from typing import Annotated

from r37core.base.declared import Key


@dataclass(frozen=True)
class Gauge:
    """A strain gauge on the blade's surface. `angle` (rad): pi/2 towards the trailing edge."""

    chord: Annotated[float, Key("Position along the chord, from leading (0) to trailing edge (1)", ge=0, le=1)]
    span: Annotated[float, Key("Position along the span, from root (0) to tip (1)", ge=0, le=1)]
    side: Annotated[str, Key("Side of the blade", one_of=("pressure", "suction"))]
    angle: Annotated[
        float, Key("Direction in the surface: 0 along the span, 90 towards the trailing edge", "_deg", ge=-180, le=180)
    ] = 0.0
