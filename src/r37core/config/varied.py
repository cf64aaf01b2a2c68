"""Keys that make one entry a family of designs: `vary` and `designs`, of blades and of scenes."""

import math
from typing import Annotated, Any, ClassVar

from pydantic import Field

from .section import FileName, LeftOut, Section, Unique, either, left_out, option, refused

LARGEST_FAMILY = 10_000
"""Designs of one entry."""


class Variation(Section):
    """Values from `start` to `stop`, both included, as far as the step goes."""

    start: float = option("First value, in the unit of the varied key", ge=-1e12, le=1e12)
    stop: float = option("Last value, if the step reaches it", ge=-1e12, le=1e12)
    step: float = option("Distance between values", ge=1e-12, le=1e12)

    def _check(self) -> None:
        if self.stop < self.start:
            raise refused(f"{self.stop:g}", f"not below start ({self.start:g})", "stop")
        if self.step > self.stop - self.start > 0.0:
            raise refused(f"{self.step:g}", f"at most stop - start ({self.stop - self.start:g})", "step")
        if (self.stop - self.start) / self.step >= LARGEST_FAMILY:
            raise refused(f"{self.step:g}", f"at most {LARGEST_FAMILY} values", "step")

    def values(self) -> list[float]:
        """All values of the range, with twelve digits: what rounding leaves of a sum is no other value."""
        count = math.floor((self.stop - self.start) / self.step + 1e-9) + 1
        return [float(f"{self.start + number * self.step:.12g}") for number in range(count)]


Varied: Any = either(Variation, rows=Unique[float])
FAMILY_KEYS = ("vary", "designs")
"""Keys of a family, of which it has one."""


class FamilyKeys(Section):
    """Keys that make an entry a family: many blades or scenes that differ in some numbers."""

    refuse_several: ClassVar[tuple[tuple[str, ...], ...]] = (FAMILY_KEYS,)

    vary: Annotated[dict[str, Varied], Field(min_length=1)] | LeftOut = left_out(
        "Family: values of numeric keys, such as sweep_percent of a blade or casing.clearance_m of a scene, each with each"
    )
    designs: FileName | LeftOut = left_out(
        "Family as a table (CSV): a design per row, its name in the column `blade` or `scene`, then numeric keys"
    )


def is_family(entry: Any) -> bool:
    """True if an entry is a family."""
    return any(getattr(entry, key, None) is not None for key in FAMILY_KEYS)
