"""scenes.yaml: what the blade meets."""

import math
import re
from collections import Counter
from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import Annotated, Any, Literal, TypeVar

import numpy as np
from pydantic import BeforeValidator, Field, RootModel, WithJsonSchema, WrapValidator, model_validator

from r37core.base.yaml_file import KeyPath
from r37core.contact.casing import Casing
from r37core.contact.elastic_casing import ElasticCasing
from r37core.contact.ring import Ring, RingMode
from r37core.contact.scene import DampingTable, Friction, Lining, Rotor, Scene
from r37core.time_integration.rotor_blades import NO_ROTOR, refusal_of

from .declaring import DECLARED, declared_by, si_fields, si_form
from .document import ConfigRefusals, Document, complete_scenes
from .section import ByName, LeftOut, Name, Rpm, Section, Speed, Unique, Without, left_out, or_section, refused
from .speed_section import refuse_both_units
from .spread import SpreadEntry
from .varied import COMBINE, Combine, DesignTable, Vary, designs_field, is_family, vary_field

TipLine = Literal["pressure_edge", "camber", "suction_edge"]
OF_ONE_BLADE = ("signal", "shapes", "motion_kind")
"""Results that a scene with a rotor cannot have."""

Result = Literal[
    "spectrum", "signal", "stress", "static_stress", "fatigue", "wear", "energy", "casing", "shapes", "motion_kind"
]


_HEIGHTS = ("amplitude_clearances", "amplitude_m")
"""Keys of the height of the lobes, of which a scene has one."""


class GrowthSection(Section):
    """Growth of the casing, linear between speeds."""

    speeds_rad_s: list[Annotated[float, Field(ge=0, le=1e6)]] | LeftOut = Field(
        default=None, min_length=2, description="Ascending speeds, from 0 to at least structure.maximum_speed_rad_s"
    )
    speeds_rpm: list[Annotated[float, Field(ge=0, le=9.5e6)]] | LeftOut = Field(
        default=None, min_length=2, description="The same speeds in revolutions per minute"
    )
    growth_m: list[Annotated[float, Field(ge=-0.01, le=0.01)]] = Field(
        min_length=2, description="Growth away from the blade at each speed, normal to the casing; 0 at the first"
    )

    def _check(self) -> None:
        keys = [key for key in ("speeds_rad_s", "speeds_rpm") if getattr(self, key) is not None]
        if len(keys) != 1:
            raise refused((), " and ".join(keys) or "no speeds", "speeds_rad_s or speeds_rpm")
        speeds = getattr(self, keys[0])
        if speeds[0] != 0.0 or any(after <= before for before, after in pairwise(speeds)):
            raise refused((keys[0],), f"{speeds}", "ascending speeds, the first of them 0")
        if len(speeds) != len(self.growth_m):
            raise refused(("growth_m",), f"{len(self.growth_m)} numbers for {len(speeds)} speeds", "one for each speed")
        if self.growth_m[0] != 0.0:
            raise refused(("growth_m", 0), f"{self.growth_m[0]:g} at speed 0", "0; the clearance there is cold_m")


class ClearanceSection(Section):
    """Clearance that changes with the speed, in place of clearance_m."""

    cold_m: float = Field(
        ge=1e-6, le=0.1, description="Clearance at rest, normal to the casing; amplitude_clearances counts it"
    )
    centrifugal: bool = Field(default=True, description="Whether the centrifugal load lengthens and untwists the blade")
    casing_growth: GrowthSection | LeftOut = None


@declared_by(Ring)
class RingSection(Section):
    """A flexible casing: a thin ring of one material on an elastic foundation, its flanges."""

    def _check(self) -> None:
        if self.thickness_m > 0.2 * self.radius_m:
            raise refused(("thickness_m",), f"{self.thickness_m:g}", f"at most a fifth of radius_m, {0.2 * self.radius_m:g}")


@declared_by(RingMode)
class RingModeSection(Section):
    """A mode of the casing, as a test or a finite-element model of it gives them; a pair where it has nodal diameters."""

    nodal_diameter: Any = DECLARED
    frequency_hz: Any = DECLARED
    modal_mass_kg: Any = DECLARED
    damping_ratio: Any = DECLARED
    tangential_ratio: Annotated[float, Field(ge=-10, le=10)] | LeftOut = left_out(
        "Tangential over radial displacement; by default 1/nodal_diameter (bending alone), or 0"
    )

    def mode(self) -> RingMode:
        """The mode as the simulations take it."""
        inextensional = 1.0 / self.nodal_diameter if self.nodal_diameter else 0.0
        tangential = inextensional if self.tangential_ratio is None else self.tangential_ratio
        return si_form(RingMode, self, frequency=2.0 * math.pi * self.frequency_hz, tangential=tangential)


@declared_by(Casing, amplitude_clearances=None)
class CasingSection(Section):
    """Shape and elasticity of the casing."""

    clearance_m: Any = DECLARED
    clearance: ClearanceSection | LeftOut = None
    cone_angle_deg: Any = DECLARED
    lobes: Any = DECLARED
    width: Any = DECLARED
    amplitude_clearances: Any = DECLARED
    amplitude_m: Any = DECLARED
    rise_fraction: Any = DECLARED
    rise_revolutions: Any = DECLARED
    ring: RingSection | LeftOut = left_out("Elastic casing as a ring; rigid without it")
    ring_modes: Annotated[list[RingModeSection], Field(min_length=1, max_length=200)] | LeftOut = left_out(
        "Elastic casing by modes, in place of ring"
    )

    @model_validator(mode="before")
    @classmethod
    def _height_written_out(cls, data: Any) -> Any:
        # the default is written out, so that it may spread like a height that is given
        if isinstance(data, Mapping) and all(data.get(key, Without.KEY) is Without.KEY for key in _HEIGHTS):
            return {**data, _HEIGHTS[0]: Casing.amplitude}
        return data

    def _check(self) -> None:
        if (self.clearance_m is None) == (self.clearance is None):
            value = "neither of clearance_m and clearance" if self.clearance is None else "clearance_m and clearance"
            raise refused((), value, "one of clearance_m and clearance")
        if self.amplitude_clearances is not None and self.amplitude_m is not None:
            raise refused((), " and ".join(_HEIGHTS), "one of them; null (None in Python) leaves out that of the base")
        if self.ring is not None and self.ring_modes is not None:
            raise refused((), "ring and ring_modes", "one of them")

    @property
    def cold_clearance(self) -> float:
        """Clearance (m) at rest, which is that of every speed where it does not depend on speed."""
        return self.clearance_m if self.clearance is None else self.clearance.cold_m

    @property
    def elastic(self) -> bool:
        """True if the casing is flexible."""
        return self.ring is not None or self.ring_modes is not None

    def elastic_casing(self) -> ElasticCasing:
        """The flexible casing, with the waves that simulations leave out; without modes where the casing is rigid."""
        if self.ring is None:
            return ElasticCasing(tuple(mode.mode() for mode in self.ring_modes or ()))
        ring = si_form(Ring, self.ring)
        return ElasticCasing(ring.modes(), ring)

    def casing(self) -> Casing:
        """The casing as the simulations take it."""
        elastic = {"ring": self.elastic_casing().modes, "ring_radius": self.ring.radius_m if self.ring else None}
        if self.clearance is None:
            return si_form(Casing, self, **elastic)
        table = si_fields(self.clearance.casing_growth or ())
        growth = {"growth_speeds": table.get("speeds", ()), "growth": table.get("growth", ())}
        cold = {"clearance": self.clearance.cold_m, "centrifugal": self.clearance.centrifugal}
        return si_form(Casing, self, **elastic, **cold, **growth)


T = TypeVar("T")

MOST_BLADES = 1000


def _number(key: Any) -> str:
    """The number of a blade as text without leading zeros; raises the error of a key that is none."""
    text = str(key).lstrip("0") if isinstance(key, str) or type(key) is int else ""
    if not re.fullmatch("[1-9][0-9]{0,3}", text) or int(text) > MOST_BLADES:
        raise refused((), f"the key {key!r}", f"the number of a blade, from 1 to {MOST_BLADES}")
    return text


def _number_table(table: Any, checked: Callable[[Any], dict[str, Any]]) -> dict[str, Any]:
    """The table as it is checked; raises the error of what is no table, and of two values of a blade."""
    if not isinstance(table, Mapping):
        raise refused((), repr(table), "a value for each number of a blade, as in {1: 0.4, 2: -0.7}")
    values = checked(table)
    twice = [number for number, times in Counter(map(_number, table)).items() if times > 1]
    if twice:
        raise refused((), f"blade {twice[0]} twice", "each blade once")
    return values


_Number = Annotated[str, BeforeValidator(_number), WithJsonSchema({"type": "string", "pattern": "^[0-9]+$"})]

BladeTable = Annotated[dict[_Number, T], WrapValidator(_number_table)]
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


class RotorSection(Section):
    """Blades that run on one casing and wear one lining; their roots stand still, and nothing else couples them."""

    blades: Number = Field(description="Number of places for blades")
    missing: Unique[Number] | LeftOut = left_out("Places without a blade, from 1")
    mistuning_percent: BladeTable[Change] = Field(
        default={}, description="Frequency change by blade number, -95 to 1000, in place of a drawn one"
    )
    mistuning_spread_percent: SpreadEntry | LeftOut = left_out(
        "Drawn frequency changes of the other blades: {normal: 1} has a standard deviation of 1%"
    )
    longer_m: BladeTable[Length] = Field(
        default={}, description="Extra length by blade number, -0.1 to 0.1, in place of a drawn one"
    )
    longer_spread_m: SpreadEntry | LeftOut = left_out(
        "Drawn extra lengths of the other blades: {uniform: 2.0e-5} is plus or minus 20 um"
    )
    seed: int = Field(default=0, ge=0, le=2**31, description="Seed of the drawn values")
    angles_deg: list[Annotated[float, Field(ge=-360, le=720)]] | LeftOut = left_out(
        "Angles of all places towards growing theta, at least 0.1 apart; equal spacing without them"
    )
    lining: Literal["shared", "separate"] = Field(
        default="shared", description="One abradable lining for all blades (shared), or one for each"
    )

    def _check(self) -> None:
        named: list[tuple[KeyPath, int]] = [(("missing",), number) for number in self.missing or ()]
        for key in _SPREADS:
            named += [((key, number), int(number)) for number in getattr(self, key)]
        for path, number in named:
            if number > self.blades:
                raise refused(path, f"blade {number}", f"1 to {self.blades}, the number of blades")
        if self.angles_deg is not None and len(self.angles_deg) != self.blades:
            raise refused(("angles_deg",), f"{len(self.angles_deg)} angles", f"{self.blades}, one for each of the blades")
        if len(self.missing or ()) == self.blades:
            raise refused(("missing",), "all blades", "at least one that is there")
        angles, around = self._angles, sorted(self._present, key=lambda number: self._angles[number - 1] % 360.0)
        for before, after in zip(around, [*around[1:], around[0]], strict=True):
            apart = (angles[after - 1] - angles[before - 1]) % 360.0
            if before != after and min(apart, 360.0 - apart) < LEAST_APART:
                both = f"{angles[after - 1]:g}, and blade {before} at {angles[before - 1]:g}"
                allowed = f"at least {LEAST_APART:g} degrees between blades that are there"
                raise refused(("angles_deg", after - 1), both, allowed)
        self._refuse_beyond("mistuning_spread_percent", *_CHANGES, self._values("mistuning_percent"))
        self._refuse_beyond("longer_spread_m", *_LENGTHS, self._values("longer_m"))

    def _refuse_beyond(self, key: str, least: float, most: float, values: list[float]) -> None:
        """Raise the error of a spread beyond the bounds, and of a blade's value that is drawn there."""
        entry: SpreadEntry | None = getattr(self, key)
        if entry is None:
            return
        if entry.percent:
            raise refused((key,), "a spread in percent of the nominal value, which is 0", "uniform, normal, between, values")
        (kind, numbers), bounds = entry.distribution, f"at least {least:g}, at most {most:g}"
        for number in numbers:
            if kind in ("uniform", "normal") and number > min(-least, most):
                raise refused((key, kind), f"{number:g}", f"at most {min(-least, most):g}")
            if not least <= number <= most:
                raise refused((key, kind), f"{number:g}", bounds)
        for blade, value in zip(self._present, values, strict=True):
            if not least <= value <= most:
                remedy = f"{bounds}; a narrower spread, a uniform one, or another seed"
                raise refused((key,), f"{value:.4g} of blade {blade}", remedy)

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

    def rotor(self) -> Rotor:
        """The blades that are there, as the simulations take them."""
        return Rotor(
            numbers=tuple(self._present),
            angles=tuple(float(np.radians(self._angles[number - 1])) for number in self._present),
            frequency_factors=tuple(1.0 + 0.01 * change for change in self._values("mistuning_percent")),
            longer=tuple(self._values("longer_m")),
            shared_lining=self.lining == "shared",
        )


@declared_by(Lining)
class LiningSection(Section):
    """The abradable lining in front of the casing."""

    def _check(self) -> None:
        published = [key for key in ("bar_width_m", "bar_area_m2") if getattr(self, key) is not None]
        # the default contact length may be there without being asked for
        asked = self.contact_length_m != type(self).model_fields["contact_length_m"].default
        given = [*(["contact_length_m"] if asked else []), *published]
        if published and len(given) > 1:
            allowed = f"one of them; {' and '.join(published)} of the published model; null leaves out that of the base"
            raise refused((given[0],), " and ".join(given), allowed)


@declared_by(Friction)
class FrictionSection(Section):
    """Friction at the tip."""

    form: Any = DECLARED


DampingNumber = Annotated[float, Field(ge=0, lt=1)]


class DampingSection(Section):
    """Damping ratio over the mode's frequency at the speed of a run: linear, constant beyond the ends."""

    frequencies_hz: list[Annotated[float, Field(ge=0, le=1e12)]] = Field(min_length=2, description="Ascending frequencies")
    ratios: list[DampingNumber] = Field(min_length=2, description="Damping ratio at each frequency")

    def _check(self) -> None:
        if any(after <= before for before, after in pairwise(self.frequencies_hz)):
            raise refused(("frequencies_hz",), f"{self.frequencies_hz}", "ascending frequencies")
        if len(self.ratios) != len(self.frequencies_hz):
            lengths = f"{len(self.ratios)} numbers for {len(self.frequencies_hz)} frequencies"
            raise refused(("ratios",), lengths, "one for each frequency")


DampingRatio: Any = or_section(DampingNumber, DampingSection)


@declared_by(Scene)
class SceneEntry(Section):
    """One scene of scenes.yaml; with `vary` or `designs` a family, many scenes that differ in some numbers."""

    base: Name | LeftOut = left_out("Scene of this file that gives what is left out; null leaves out a key that it has")
    tip_line: TipLine | LeftOut = left_out("Line of the contact nodes; by default structure.boundary.tip_line")
    casing: CasingSection
    lining: LiningSection | LeftOut = left_out("Abradable lining; the casing is bare without it")
    friction: FrictionSection | LeftOut = left_out("Friction at the tip")
    rotor: RotorSection | LeftOut = left_out("All blades in one casing; a single blade without it")
    damping_ratio: DampingRatio = Field(default=0.0005, description="Damping ratio of all modes, or a table")
    gap: Any = DECLARED
    divergence_limit_m: Any = DECLARED
    revolutions: Annotated[int, Field(ge=1, le=20000)] | LeftOut = left_out(
        "Revolutions of a run, in place of the fidelity level's"
    )
    until: Literal["revolutions", "settled"] | LeftOut = left_out("End of a run, in place of the fidelity level's")
    results: list[Result] = Field(
        default=["spectrum", "stress"],
        json_schema_extra={"uniqueItems": True},
        description="Kept results; static_stress adds the stress of rotation, fatigue compares stress with the Goodman line, "
        "casing keeps the waves of an elastic casing, motion_kind says whether the motion is chaotic",
    )
    stress_history_speeds_rad_s: list[Speed] = Field(
        default=[], description="Speeds at which the largest stress of every revolution is kept"
    )
    stress_history_speeds_rpm: list[Rpm] = Field(default=[], description="The same speeds in revolutions per minute")
    vary: Vary = vary_field("casing.clearance_m or lining.thickness_m")
    combine: Combine = COMBINE
    designs: DesignTable = designs_field("scene")

    def _check(self) -> None:
        is_family(self)
        histories = ("stress_history_speeds_rad_s", "stress_history_speeds_rpm")
        if all(getattr(self, key) for key in histories):
            refuse_both_units(*histories)
        for key in ("results", *histories):
            values = getattr(self, key)
            for number, value in enumerate(values):
                if value in values[:number]:
                    raise refused((key, number), f"{value} twice", "each once")
        if "wear" in self.results and self.lining is None:
            raise refused(("results",), "wear", "only in a scene with a lining")
        if "casing" in self.results and not self.casing.elastic:
            raise refused(("results",), "casing", "only in a scene whose casing has a ring or ring_modes")
        for result in ("shapes", "static_stress", "fatigue"):
            if result in self.results and "stress" not in self.results:
                raise refused(("results",), result, "only with stress among the results")
        for key in histories:
            if getattr(self, key) and "stress" not in self.results:
                raise refused((key,), "speeds", "only with stress among the results")
        if self.casing.elastic and self.gap == "exact":
            raise refused(
                ("gap",), "exact with an elastic casing", "linear; the exact gap is that of a casing that keeps its shape"
            )
        if self.rotor is not None:
            self._check_rotor()

    def _check_rotor(self) -> None:
        refusal = refusal_of(self.scene())
        if refusal:
            raise refused(("rotor",), "a rotor in this scene", refusal)
        if self.until == "settled":
            raise refused(("until",), "settled with a rotor", NO_ROTOR)
        for result in OF_ONE_BLADE:
            if result in self.results:
                raise refused(
                    ("results",), f"{result} with a rotor", "results of all blades together; a scene without rotor has it"
                )

    def stress_history_speeds(self) -> tuple[float, ...]:
        """Speeds (rad/s) at which the largest stress of every revolution is kept."""
        keys = ("stress_history_speeds_rad_s", "stress_history_speeds_rpm")
        return si_fields((key, getattr(self, key)) for key in keys)["stress_history_speeds"]

    def scene(self) -> Scene:
        """The scene as the simulations take it."""
        lining = self.lining and si_form(Lining, self.lining)
        friction = self.friction and si_form(Friction, self.friction)
        rotor = self.rotor and self.rotor.rotor()
        damping: Any = self.damping_ratio
        if isinstance(damping, DampingSection):
            damping = DampingTable(**si_fields(damping))
        parts = {"lining": lining, "friction": friction, "rotor": rotor, "damping_ratio": damping}
        return si_form(Scene, self, casing=self.casing.casing(), **parts)


class Scenes(RootModel[ByName[SceneEntry]]):
    """scenes.yaml, contact scenes by name."""


def checked_scenes(file: Document, above: Document | None = None) -> tuple[Document, dict[str, SceneEntry]]:
    """Scenes of a file with changes `above`, each with what its base gives it: content with its lines, and checked.

    Raises ConfigError for all that is wrong.
    """
    document, refused_bases = complete_scenes(file, above)
    refusals = ConfigRefusals()
    # of a file in which all have such bases nothing is left
    checked = refusals.of(document.check, Scenes) if document.content or not file.content else None
    refusals.of(refused_bases.tell)
    refusals.tell()
    assert checked
    return document, checked.root
