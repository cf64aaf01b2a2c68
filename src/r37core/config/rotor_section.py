"""rotor of a scene: the blades that meet it together, and how they differ."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, model_validator

from r37core.contact.rotor import Rotor

from .section import LeftOut, Section, Unique, refused
from .spread import SpreadEntry

MOST_BLADES = 1000
LEAST_FACTOR = 0.05
"""Of a blade's frequencies."""

Number = Annotated[int, Field(ge=1, le=MOST_BLADES)]
Change = Annotated[float, Field(gt=-100, le=1000)]
Length = Annotated[float, Field(ge=-0.1, le=0.1)]


class RotorSection(Section):
    """Blades that run on one casing and wear one lining; their roots stand still, and nothing else couples them."""

    blades: Number = Field(description="how many places for blades there are")
    missing: Unique[Number] | LeftOut = Field(default=None, description="numbers of the places without a blade, from 1")
    mistuning_percent: dict[Number, Change] = Field(
        default={}, description="number of a blade -> change of all its frequencies; in place of what is drawn"
    )
    mistuning_spread_percent: SpreadEntry | LeftOut = Field(
        default=None,
        description="how the other blades' frequencies differ, drawn: {normal: 1} has a standard deviation of 1%",
    )
    longer_m: dict[Number, Length] = Field(
        default={}, description="number of a blade -> by how much it is longer than the model; in place of what is drawn"
    )
    longer_spread_m: SpreadEntry | LeftOut = Field(
        default=None, description="how the lengths of the other blades differ, drawn: {uniform: 2.0e-5} is plus or minus 20 um"
    )
    seed: int = Field(default=0, ge=0, le=2**31, description="of what is drawn; another one gives another rotor")
    angles_deg: list[Annotated[float, Field(ge=-360, le=720)]] | LeftOut = Field(
        default=None, description="angles of all places, in the sense of growing theta; equal without them"
    )
    lining: Literal["shared", "separate"] = Field(
        default="shared", description="separate: each blade has a lining of its own, as a single blade does"
    )

    @model_validator(mode="after")
    def _numbers_are_places(self) -> RotorSection:
        for key in ("missing", "mistuning_percent", "longer_m"):
            for number in getattr(self, key) or ():
                if number > self.blades:
                    raise refused((key,), f"blade {number}", f"1 to {self.blades}, the number of blades")
        if self.angles_deg is not None and len(self.angles_deg) != self.blades:
            raise refused(("angles_deg",), f"{len(self.angles_deg)} angles", f"{self.blades}, one for each of the blades")
        if len(self.missing or ()) == self.blades:
            raise refused(("missing",), "all blades", "at least one that is there")
        for key in ("mistuning_spread_percent", "longer_spread_m"):
            spread = getattr(self, key)
            if spread is not None and spread.spread().percent:
                raise refused(
                    (key,), "a spread in percent of the nominal value, which is 0", "uniform, normal, between, values"
                )
        for number, factor in zip(self._present, self._factors, strict=True):
            if factor < LEAST_FACTOR:
                remedy = f"at least {100.0 * (LEAST_FACTOR - 1.0):g}; a narrower spread, a uniform one, or another seed"
                raise refused(("mistuning_spread_percent",), f"{100.0 * (factor - 1.0):.4g} of blade {number}", remedy)
        return self

    @property
    def _present(self) -> list[int]:
        return [number for number in range(1, self.blades + 1) if number not in (self.missing or ())]

    @property
    def _factors(self) -> list[float]:
        changes = self._values(self.mistuning_percent, self.mistuning_spread_percent, 0)
        return [1.0 + 0.01 * change for change in changes]

    def _values(self, table: dict[int, float], spread: SpreadEntry | None, stream: int) -> list[float]:
        """Of the blades that are there: those of the table, else drawn; a blade keeps its draw where others are missing."""
        shares = np.random.default_rng((self.seed, stream)).random(self.blades)
        drawn = spread and spread.spread()
        nominal = [drawn.value(0.0, float(share)) if drawn else 0.0 for share in shares]
        return [table.get(number, nominal[number - 1]) for number in self._present]

    def rotor(self) -> Rotor:
        """The blades that are there, as the simulations take them."""
        angles: Any = self.angles_deg or 360.0 / self.blades * np.arange(self.blades)
        return Rotor(
            numbers=tuple(self._present),
            angles=tuple(float(np.radians(angles[number - 1])) for number in self._present),
            frequency_factors=tuple(self._factors),
            longer=tuple(self._values(self.longer_m, self.longer_spread_m, 1)),
            shared_lining=self.lining == "shared",
        )
