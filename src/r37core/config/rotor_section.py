"""rotor of a scene: the blades that meet it together, and how they differ."""

import re
from typing import Annotated, Any, Literal, TypeVar

import numpy as np
from pydantic import BeforeValidator, Field

from r37core.base.yaml_file import KeyPath
from r37core.contact.scene import Rotor

from .declaring import declared_by
from .section import LeftOut, Section, Unique, left_out, option, refused
from .spread import SpreadEntry

T = TypeVar("T")

MOST_BLADES = 1000


def _number(key: Any) -> str:
    """The number of a blade as text; raises the error of a key that is none."""
    if not re.fullmatch("[1-9][0-9]{0,3}", text := str(key)) or int(text) > MOST_BLADES:
        raise refused(f"the key {key!r}", f"the number of a blade, from 1 to {MOST_BLADES}")
    return text


BladeTable = dict[Annotated[str, BeforeValidator(_number)], T]
"""Values by numbers of blades, which are the texts "1", "2", ... of a checked table."""

LEAST_APART = 0.1
"""Smallest angle between blades (deg): less than a tip is thick, and less than between MOST_BLADES at equal angles."""

_CHANGES, _LENGTHS = (-95.0, 1000.0), (-0.1, 0.1)
"""Least and largest, of the keys mistuning_percent and longer_m, given or drawn."""

_SPREADS = {"mistuning_percent": "mistuning_spread_percent", "longer_m": "longer_spread_m"}
"""Table of values by blades -> how the others are drawn, each from a stream of its own."""

Number = Annotated[int, Field(ge=1, le=MOST_BLADES)]
Change = Annotated[float, Field(ge=_CHANGES[0], le=_CHANGES[1])]
Length = Annotated[float, Field(ge=_LENGTHS[0], le=_LENGTHS[1])]


@declared_by(Rotor)
class RotorSection(Section):
    """Blades that run on one casing and wear one lining; their roots stand still, and nothing else couples them."""

    blades: Number = option("Number of places for blades")
    missing: Unique[Number] | LeftOut = left_out("Places without a blade, from 1")
    mistuning_percent: BladeTable[Change] = option("Frequency change by blade number, -95 to 1000, in place of a drawn one", {})
    mistuning_spread_percent: SpreadEntry | LeftOut = left_out(
        "Drawn frequency changes of the other blades: {normal: 1} has a standard deviation of 1%"
    )
    longer_m: BladeTable[Length] = option("Extra length by blade number, -0.1 to 0.1, in place of a drawn one", {})
    longer_spread_m: SpreadEntry | LeftOut = left_out(
        "Drawn extra lengths of the other blades: {uniform: 2.0e-5} is plus or minus 20 um"
    )
    seed: int = option("Seed of the drawn values", 0, ge=0, le=2**31)
    angles_deg: list[Annotated[float, Field(ge=-360, le=720)]] | LeftOut = left_out(
        "Angles of all places towards growing theta, at least 0.1 apart; equal spacing without them"
    )
    lining: Literal["shared", "separate"] = option("One abradable lining for all blades (shared), or one for each", "shared")

    def _check(self) -> None:
        named: list[tuple[KeyPath, int]] = [(("missing",), number) for number in self.missing or ()]
        for key in _SPREADS:
            named += [((key, number), int(number)) for number in getattr(self, key)]
        for path, number in named:
            if number > self.blades:
                raise refused(f"blade {number}", f"1 to {self.blades}, the number of blades", *path)
        if self.angles_deg is not None and len(self.angles_deg) != self.blades:
            raise refused(f"{len(self.angles_deg)} angles", f"{self.blades}, one for each of the blades", "angles_deg")
        if len(self.missing or ()) == self.blades:
            raise refused("all blades", "at least one that is there", "missing")
        angles, around = self._angles, sorted(self._present, key=lambda number: self._angles[number - 1] % 360.0)
        for before, after in zip(around, [*around[1:], around[0]], strict=True):
            apart = (angles[after - 1] - angles[before - 1]) % 360.0
            if before != after and min(apart, 360.0 - apart) < LEAST_APART:
                both = f"{angles[after - 1]:g}, and blade {before} at {angles[before - 1]:g}"
                allowed = f"at least {LEAST_APART:g} degrees between blades that are there"
                raise refused(both, allowed, "angles_deg", after - 1)
        self._refuse_beyond("mistuning_spread_percent", *_CHANGES, self._values("mistuning_percent"))
        self._refuse_beyond("longer_spread_m", *_LENGTHS, self._values("longer_m"))

    def _refuse_beyond(self, key: str, least: float, most: float, values: list[float]) -> None:
        """Raise the error of a spread beyond the bounds, and of a blade's value that is drawn there."""
        entry: SpreadEntry | None = getattr(self, key)
        if entry is None:
            return
        if entry.percent:
            raise refused("a spread in percent of the nominal value, which is 0", "uniform, normal, between, values", key)
        (kind, numbers), bounds = entry.distribution, f"at least {least:g}, at most {most:g}"
        for number in numbers:
            if kind in ("uniform", "normal") and number > min(-least, most):
                raise refused(f"{number:g}", f"at most {min(-least, most):g}", key, kind)
            if not least <= number <= most:
                raise refused(f"{number:g}", bounds, key, kind)
        for blade, value in zip(self._present, values, strict=True):
            if not least <= value <= most:
                remedy = f"{bounds}; a narrower spread, a uniform one, or another seed"
                raise refused(f"{value:.4g} of blade {blade}", remedy, key)

    @property
    def _present(self) -> list[int]:
        return [number for number in range(1, self.blades + 1) if number not in (self.missing or ())]

    @property
    def _angles(self) -> list[float]:
        """Angles of all places (deg)."""
        return self.angles_deg or [360.0 / self.blades * place for place in range(self.blades)]

    def _values(self, key: str) -> list[float]:
        """Values of the blades that are there, of the table or else drawn; a blade keeps its draw where others are missing."""
        table, spread = getattr(self, key), getattr(self, _SPREADS[key])
        shares = np.random.default_rng((self.seed, list(_SPREADS).index(key))).random(self.blades)
        nominal = [spread.value(0.0, float(share)) if spread else 0.0 for share in shares]
        return [table.get(str(number), nominal[number - 1]) for number in self._present]

    def parts(self) -> dict[str, Any]:
        """The blades that are there, as the simulations take them."""
        return {
            "numbers": tuple(self._present),
            "angles": tuple(float(np.radians(self._angles[number - 1])) for number in self._present),
            "frequency_factors": tuple(1.0 + 0.01 * change for change in self._values("mistuning_percent")),
            "longer": tuple(self._values("longer_m")),
            "shared_lining": self.lining == "shared",
        }
