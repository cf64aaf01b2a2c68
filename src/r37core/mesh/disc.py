"""Disc under a blade that this program meshes, as it is chosen. Light: the configuration imports it."""

from dataclasses import dataclass
from typing import Annotated

from r37core.base.declared import Key

OVERHANG = 0.1
"""Width of the rim beyond the root at each end, as a share of the root's."""


@dataclass(frozen=True)
class Disc:
    """Rim under the blade's root, a web at the middle of its width, and a clamped bore.

    The rim is wider than the root by a tenth at both ends.
    """

    web: Annotated[float, Key("Axial thickness of the web", "_m", ge=1e-4, le=10)]
    rim: Annotated[float, Key("Radial thickness of the rim", "_m", ge=1e-4, le=10)]
    bore_radius: Annotated[float, Key("Radius of the clamped bore", "_m", ge=1e-3, le=100)]
    sectors: Annotated[int, Key("Number of blades on the disc", ge=3, le=400)]
