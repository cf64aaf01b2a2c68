"""search of config.yaml: a blade that is better than the one at hand."""

import math
from itertools import chain
from typing import Annotated, Any, Literal, Self

from pydantic import Field

from r37core.config.section import (
    ByName,
    ExtensionSection,
    LeftOut,
    Name,
    Named,
    Names,
    Section,
    Speed,
    left_out,
    option,
    plain,
    refused,
)
from r37core.config.spread import Bounds, Number

from .measures import MEASURES, STRUCTURE_MEASURES

OPERATING_MEASURE = "exceedance_integral_operating_rad_s"
"""Measure of a quantity without one, where there is an operating range."""

COLUMNS = ("design", "round", "feasible", "not_dominated", "order", "refused")
"""Columns of search.csv next to those of variables, objectives and constraints."""


_PLACES = ("scenes", "mode", "engine_order", "speed_rad_s")


class QuantitySection(Section):
    """A number of a design."""

    measure: Literal[tuple(MEASURES)] = option(  # type: ignore[valid-type]
        "Number of a design: of contact a column of ranking.csv; "
        + "; ".join(f"{name}, {words}" for name, (words, _, _) in STRUCTURE_MEASURES.items()),
        "exceedance_integral_rad_s",
    )
    scenes: Names | LeftOut = left_out("Scenes of a contact measure; the worst counts")
    mode: str | LeftOut = left_out("Mode of a modal measure, such as 1B")
    engine_order: Annotated[int, Field(ge=1, le=1000)] | LeftOut = left_out("Engine order of a margin")
    speed_rad_s: Speed | LeftOut = left_out("Speed of a margin or static stress (by default the highest of the model)")

    def _check(self) -> None:
        named = [key for key in _PLACES if getattr(self, key) is not None]
        _, needed, allowed = MEASURES[self.measure]
        if missing := [key for key in needed if key not in named]:
            raise refused(f"{self.measure} without {', '.join(missing)}", f"{' and '.join(needed)} beside it")
        if strange := [key for key in named if key not in (*needed, *allowed)]:
            raise refused(f"{strange[0]} with {self.measure}", "the key left out", strange[0])

    @property
    def made_of(self) -> dict[str, Any]:
        """All that the value of a design follows from, bounds left out."""
        return {key: getattr(self, key) for key in ("measure", *_PLACES)}

    def chosen(self, is_flown: bool) -> Self:
        """The quantity that is computed; without a measure that over the operating range, where there is one."""
        default = {} if "measure" in self.model_fields_set or not is_flown else {"measure": OPERATING_MEASURE}
        return self.model_copy(update=default)


class ConstraintSection(QuantitySection):
    """Bounds of a number of a design; with percent, of the value of the start."""

    refuse_several = (("at_least", "at_least_percent"), ("at_most", "at_most_percent"))

    at_least: Number | LeftOut = left_out("Lower bound, in the unit of the measure")
    at_most: Number | LeftOut = left_out("Upper bound, in the unit of the measure")
    at_least_percent: Number | LeftOut = left_out("Lower bound, of the starting blade's value")
    at_most_percent: Number | LeftOut = left_out("Upper bound, of the starting blade's value")

    def _check(self) -> None:
        super()._check()
        limits = plain(self)
        for percent in ("", "_percent"):
            lowest, highest = f"at_least{percent}", f"at_most{percent}"
            if limits.get(lowest, -math.inf) > limits.get(highest, math.inf):
                raise refused(f"{limits[lowest]:g}", f"not above {highest} ({limits[highest]:g})", lowest)
        if limits.keys().isdisjoint(chain.from_iterable(self.refuse_several)):
            raise refused("no bound", "at_least or at_most, or one of them in percent of the start")

    def bounds(self, start: float) -> tuple[float, float]:
        """Lowest and highest value, infinite without a bound, where the start has the value `start`."""
        low = self.at_least if self.at_least_percent is None else 0.01 * self.at_least_percent * start
        high = self.at_most if self.at_most_percent is None else 0.01 * self.at_most_percent * start
        return -math.inf if low is None else low, math.inf if high is None else high


class SearchSection(Section):
    """A search for better designs of one blade and its scenes, in rounds: each asks for more by what all before them gave."""

    blade: Name = option("Blade of the run at which the search starts")
    variables: dict[str, Bounds] = option(
        "Lowest and highest value of numeric keys of the entry, such as stagger_deg.tip: [-3, 3], and of the "
        "scenes that have the number, such as scene.lining.thickness_m: [0.001, 0.005]",
        min_length=1,
    )
    objectives: ByName[QuantitySection] = option(
        "Numbers to minimise, by name, such as lined: {scenes: [abradable]}; several give a Pareto front"
    )
    constraints: Named[ConstraintSection] = option(
        "Limits, by name, such as first: {measure: frequency_hz, mode: 1B, at_least_percent: 98}", {}
    )
    designs: int = option("Number of designs to run", 60, ge=2, le=2000)
    first: int = option("Number of first designs, from a quasi-random sequence; as large as designs: all", 16, ge=2, le=2000)
    batch: int = option("Number of designs per round, run in parallel", 4, ge=1, le=500)
    seed: int = option("Seed of the search", 0, ge=0, le=2**31)

    def _check(self) -> None:
        if self.first > self.designs:
            raise refused(f"{self.first}", f"at most designs ({self.designs})", "first")
        for key in self.variables:
            if inner := next((other for other in self.variables if other.startswith(f"{key}.")), None):
                raise refused(f"{inner} beside {key}", "one of them: the other would replace it", "variables", inner)
        self._columns_differ()

    def _columns_differ(self) -> None:
        """Objectives and constraints are columns of one table, beside those of the designs."""
        taken = {name.lower() for name in (*COLUMNS, *self.variables)}
        for where, names in (("objectives", self.objectives), ("constraints", self.constraints)):
            for name in names:
                if name.lower() in taken:
                    raise refused(f"'{name}' twice", "a name that no other column of search.csv has", where, name)
                taken |= {name.lower(), f"{name.lower()}_scatter"} if where == "objectives" else {name.lower()}


SECTION: ExtensionSection[SearchSection | None] = ExtensionSection(
    "search",
    SearchSection | LeftOut,  # type: ignore[arg-type]
    left_out("Search for better designs of one blade (docs/better_blade.md)"),
)
