"""Keys that make one entry a family of designs: `vary`, `combine` and `designs`, of blades and of scenes."""

import math
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from .section import FileName, LeftOut, Section, Unique, left_out, refused

LARGEST_FAMILY = 10_000
"""Designs of one entry."""


class Variation(Section):
    """Values from `start` to `stop`, both included, as far as the step goes."""

    start: float = Field(ge=-1e12, le=1e12, description="First value, in the unit of the varied key")
    stop: float = Field(ge=-1e12, le=1e12, description="Last value, if the step reaches it")
    step: float = Field(ge=1e-12, le=1e12, description="Distance between values")

    def _check(self) -> None:
        if self.stop < self.start:
            raise refused(("stop",), f"{self.stop:g}", f"not below start ({self.start:g})")
        if self.step > self.stop - self.start > 0.0:
            raise refused(("step",), f"{self.step:g}", f"at most stop - start ({self.stop - self.start:g})")
        if (self.stop - self.start) / self.step >= LARGEST_FAMILY:
            raise refused(("step",), f"{self.step:g}", f"at most {LARGEST_FAMILY} values")

    def values(self) -> list[float]:
        """All values of the range, with twelve digits: what rounding leaves of a sum is no other value."""
        count = math.floor((self.stop - self.start) / self.step + 1e-9) + 1
        return [float(f"{self.start + number * self.step:.12g}") for number in range(count)]


Varied = Annotated[
    Annotated[Unique[float], Tag("list")] | Annotated[Variation, Tag("range")],
    Discriminator(lambda value: "list" if isinstance(value, list) else "range"),
]
Vary = Annotated[dict[str, Varied], Field(min_length=1)] | LeftOut
Combine = Literal["grid", "pairs"]
DesignTable = FileName | LeftOut
COMBINE: Any = Field(default="grid", description="grid combines every value with every other, pairs the first with the first")
FAMILY_WAYS = ("vary", "designs")
FAMILY_KEYS = (*FAMILY_WAYS, "combine")
"""Keys of a family, of which it has one of FAMILY_WAYS."""


def vary_field(example: str) -> Any:
    """Field of the key `vary`; `example`: of keys."""
    return left_out(f"Family: values of numeric keys, such as {example}")


def designs_field(kind: str) -> Any:
    """Field of the key `designs` of a `kind` of entry."""
    return left_out(f"Family as a table (CSV): a design per row, its name in the column `{kind}`, then numeric keys")


def is_family(entry: Any) -> bool:
    """True if an entry is a family."""
    return any(getattr(entry, key, None) is not None for key in FAMILY_WAYS)
