"""search of config.yaml: a blade that is better than the one at hand."""

import math
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, Field

from r37core.config.section import ByName, ExtensionSection, LeftOut, Name, Names, Section, Speed, check_names, plain, refused
from r37core.config.spread import Bounds, MemberCount, Number, Spreads

from .measures import MEASURES, MINIMISED, STRUCTURE_MEASURES

OPERATING_MEASURE = "exceedance_integral_operating_rad_s"
"""Measure of a quantity without one, where there is an operating range."""

COLUMNS = ("design", "round", "feasible", "not_dominated", "order", "refused")
"""Columns of search.csv next to those of variables, objectives and constraints."""


_PLACES = ("scenes", "mode", "engine_order", "speed_rad_s")


class QuantitySection(Section):
    """A number of a design."""

    measure: Literal[tuple(MEASURES)] = Field(  # type: ignore[valid-type]
        default="exceedance_integral_rad_s",
        description="Number of a design: of contact a column of ranking.csv; "
        + "; ".join(f"{name}, {words}" for name, (words, _, _) in STRUCTURE_MEASURES.items()),
    )
    scenes: Names | LeftOut = Field(default=None, description="Scenes of a contact measure; the worst counts")
    mode: str | LeftOut = Field(default=None, description="Mode of a modal measure, such as 1B")
    engine_order: Annotated[int, Field(ge=1, le=1000)] | LeftOut = Field(default=None, description="Engine order of a margin")
    speed_rad_s: Speed | LeftOut = Field(
        default=None, description="Speed of a margin or static stress (by default the highest of the model)"
    )

    def _check(self) -> None:
        named = [key for key in _PLACES if getattr(self, key) is not None]
        _, needed, allowed = MEASURES[self.measure]
        if missing := [key for key in needed if key not in named]:
            raise refused((), f"{self.measure} without {', '.join(missing)}", f"{' and '.join(needed)} beside it")
        if strange := [key for key in named if key not in (*needed, *allowed)]:
            raise refused((strange[0],), f"{strange[0]} with {self.measure}", "the key left out")

    @property
    def made_of(self) -> dict[str, Any]:
        """All that the value of a design follows from, bounds left out."""
        return {key: getattr(self, key, None) for key in ("measure", *_PLACES, "quantile")}

    def chosen(self, is_flown: bool) -> Self:
        """The quantity that is computed; without a measure that over the operating range, where there is one."""
        default = {} if "measure" in self.model_fields_set or not is_flown else {"measure": OPERATING_MEASURE}
        return self.model_copy(update=default)


class ObjectiveSection(QuantitySection):
    """Number of a design that should be small."""

    quantile: Annotated[float, Field(ge=1e-3, le=0.999)] | LeftOut = Field(
        default=None, description="Quantile under tolerances, such as 0.9; the nominal value without it"
    )

    def _check(self) -> None:
        super()._check()
        if self.quantile is not None and self.measure not in MINIMISED:
            raise refused(("quantile",), f"a quantile of {self.measure}", f"one of {', '.join(MINIMISED)}")


class ConstraintSection(QuantitySection):
    """Bounds of a number of a design; with percent, of the value of the start."""

    at_least: Number | LeftOut = Field(default=None, description="Lower bound, in the unit of the measure")
    at_most: Number | LeftOut = Field(default=None, description="Upper bound, in the unit of the measure")
    at_least_percent: Number | LeftOut = Field(default=None, description="Lower bound, of the starting blade's value")
    at_most_percent: Number | LeftOut = Field(default=None, description="Upper bound, of the starting blade's value")

    def _check(self) -> None:
        super()._check()
        ends = ("at_least", "at_most"), ("at_least_percent", "at_most_percent")
        limits = plain(self)
        for keys in zip(*ends, strict=True):
            if all(key in limits for key in keys):
                raise refused((keys[1],), " and ".join(keys), "one of them")
        for lowest, highest in ends:
            if lowest in limits and highest in limits and limits[lowest] > limits[highest]:
                raise refused((lowest,), f"{limits[lowest]:g}", f"not above {highest} ({limits[highest]:g})")
        if not any(key in limits for keys in ends for key in keys):
            raise refused((), "no bound", "at_least or at_most, or one of them in percent of the start")

    def bounds(self, start: float) -> tuple[float, float]:
        """Lowest and highest value, infinite without a bound, where the start has the value `start`."""
        low = self.at_least if self.at_least_percent is None else 0.01 * self.at_least_percent * start
        high = self.at_most if self.at_most_percent is None else 0.01 * self.at_most_percent * start
        return -math.inf if low is None else low, math.inf if high is None else high


class SearchTolerances(Spreads):
    """Numbers that spread about those of every design, for objectives that are a quantile."""

    members: MemberCount = Field(default=16, description="Members of every design, a power of two")


class SearchSection(Section):
    """A search for better designs of one blade and its scenes, in rounds: each asks for more by what all before them gave."""

    blade: Name = Field(description="Blade of the run at which the search starts")
    variables: Annotated[dict[str, Bounds], Field(min_length=1)] = Field(
        description="Lowest and highest value of numeric keys of the entry, such as stagger_deg.tip: [-3, 3], and of the "
        "scenes that have the number, such as scene.lining.thickness_m: [0.001, 0.005]"
    )
    objectives: ByName[ObjectiveSection] = Field(
        description="Numbers to minimise, by name, such as lined: {scenes: [abradable]}; several give a Pareto front"
    )
    constraints: Annotated[dict[Name, ConstraintSection], AfterValidator(check_names)] = Field(
        default={}, description="Limits, by name, such as first: {measure: frequency_hz, mode: 1B, at_least_percent: 98}"
    )
    designs: int = Field(default=60, ge=2, le=2000, description="Number of designs to run")
    first: int = Field(default=16, ge=2, le=2000, description="Number of first designs, from a quasi-random sequence")
    batch: int = Field(default=4, ge=1, le=500, description="Number of designs per round, run in parallel")
    method: Literal["surrogate", "quasi_random"] = Field(
        default="surrogate", description="Way to propose designs; quasi_random spreads them evenly, for comparison"
    )
    seed: int = Field(default=0, ge=0, le=2**31, description="Seed of the search")
    tolerances: SearchTolerances | LeftOut = Field(default=None, description="Tolerances of objectives with a quantile")

    def _check(self) -> None:
        if self.first > self.designs:
            raise refused(("first",), f"{self.first}", f"at most designs ({self.designs})")
        quantiles = [name for name, objective in self.objectives.items() if objective.quantile is not None]
        if quantiles and not (self.tolerances and self.tolerances.spreads):
            where = ("objectives", quantiles[0], "quantile")
            raise refused(where, "a quantile", "tolerances beside it, with numbers that spread")
        if self.tolerances is not None and not quantiles:
            raise refused(
                ("tolerances",), "tolerances that no objective needs", "an objective with a quantile, or none of them"
            )
        for key in self.variables:
            if inner := next((other for other in self.variables if other.startswith(f"{key}.")), None):
                raise refused(("variables", inner), f"{inner} beside {key}", "one of them: the other would replace it")
        self._columns_differ()

    def _columns_differ(self) -> None:
        """Objectives and constraints are columns of one table, beside those of the designs."""
        taken = {name.lower() for name in (*COLUMNS, *self.variables)}
        for where, names in (("objectives", self.objectives), ("constraints", self.constraints)):
            for name in names:
                if name.lower() in taken:
                    raise refused((where, name), f"'{name}' twice", "a name that no other column of search.csv has")
                taken |= {name.lower(), f"{name.lower()}_scatter"} if where == "objectives" else {name.lower()}


SECTION: ExtensionSection[SearchSection | None] = ExtensionSection(
    "search",
    SearchSection | LeftOut,  # type: ignore[arg-type]
    Field(default=None, description="Search for better designs of one blade (docs/better_blade.md)"),
)
