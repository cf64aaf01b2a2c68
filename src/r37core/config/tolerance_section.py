"""tolerances of config.yaml: numbers that are never known exactly."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, Field, model_validator

from r37core.tolerances.sample import Tolerance

from .section import AllOrNames, LeftOut, Section, Unique, refused

_KINDS = ("uniform_percent", "uniform", "normal_percent", "normal", "between", "values")
Width = Annotated[float, Field(gt=0, le=1e15)]
Percent = Annotated[float, Field(gt=0, le=1000)]
Number = Annotated[float, Field(ge=-1e15, le=1e15)]


def _power_of_two(members: int) -> int:
    if members & (members - 1):
        nearest = 2 ** members.bit_length()
        raise refused((), f"{members}", f"a power of two, such as {nearest // 2} or {nearest}")
    return members


MemberCount = Annotated[int, Field(ge=2, le=4096), AfterValidator(_power_of_two)]
"""How many members a sample has."""


class ToleranceEntry(Section):
    """How one number spreads: one of these, in the unit of the number's key where it is not in percent of its value."""

    uniform_percent: Percent | LeftOut = Field(default=None, description="half width; 5: from 5% below to 5% above")
    uniform: Width | LeftOut = Field(default=None, description="half width")
    normal_percent: Percent | LeftOut = Field(default=None, description="standard deviation")
    normal: Width | LeftOut = Field(default=None, description="standard deviation")
    between: Annotated[list[Number], Field(min_length=2, max_length=2)] | LeftOut = Field(
        default=None, description="lower and upper bound, all between equally likely"
    )
    values: Unique[Number] | LeftOut = Field(default=None, description="a list, each equally likely")

    @model_validator(mode="after")
    def _one_kind(self) -> ToleranceEntry:
        given = [key for key in _KINDS if getattr(self, key) is not None]
        if len(given) != 1:
            raise refused((), " and ".join(given) or "nothing", f"one of {', '.join(_KINDS)}")
        if self.between is not None and not self.between[0] < self.between[1]:
            raise refused(("between",), f"{self.between}", "a lower and a higher number")
        return self

    def tolerance(self) -> Tolerance:
        """As the sample takes it."""
        key = next(key for key in _KINDS if getattr(self, key) is not None)
        given = getattr(self, key)
        numbers = tuple(given) if isinstance(given, list) else (given,)
        return Tolerance(key.removesuffix("_percent"), numbers, key.endswith("_percent"))  # type: ignore[arg-type]


class ToleranceSection(Section):
    """Numbers that spread, and how many members are drawn of them; without any there are none."""

    of_scenes: dict[str, ToleranceEntry] = Field(
        default={}, description="by dotted keys of scenes.yaml, such as lining.elastic_modulus_pa"
    )
    of_blades: dict[str, ToleranceEntry] = Field(
        default={},
        description="by material.<key>, sweep_percent and lean_percent of the table, sweep_cm and lean_deg added at the tip "
        "(in proportion to the span), thickness_percent of all profiles",
    )
    members: MemberCount = Field(default=32, description="a power of two; more of them change none that are there")
    seed: int = Field(default=0, ge=0, le=2**31, description="another one gives another sample")
    sensitivity: bool = Field(
        default=False, description="Sobol indices, which take as many members again for each number, and once more"
    )
    blades: AllOrNames = Field(default="all", description="of those that are run")
    scenes: AllOrNames = Field(default="all", description="of those that are run")
    largest_share: float = Field(
        default=0.2, gt=0, le=1, description="of the finest grid of adaptive speeds that is run at most, by every member"
    )

    @property
    def tolerances(self) -> dict[tuple[str, str], Tolerance]:
        """Section and key of each number -> how it spreads, in the order of the sample."""
        return {
            (section, key): entry.tolerance()
            for section in ("of_blades", "of_scenes")
            for key, entry in getattr(self, section).items()
        }
