"""scenes.yaml: what the blade meets."""

from itertools import pairwise
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, RootModel

from r37core.contact.scene import DampingRow, DampingTable, Friction, Lining, Scene
from r37core.time_integration.rotor_blades import NO_ROTOR, refusal_of

from .casing_section import CasingSection
from .declaring import DECLARED, declared_by, si_fields, si_form
from .document import ConfigRefusals, Document, completed
from .rotor_section import RotorSection
from .section import ByName, LeftOut, Name, Rpm, Section, Speed, left_out, or_section, refused
from .speed_section import refuse_both_units
from .varied import COMBINE, Combine, DesignTable, Vary, designs_field, is_family, vary_field

TipLine = Literal["pressure_edge", "camber", "suction_edge"]
OF_ONE_BLADE = ("signal", "shapes", "motion_kind")
"""Results that a scene with a rotor cannot have."""

Result = Literal[
    "spectrum", "signal", "stress", "static_stress", "fatigue", "wear", "energy", "casing", "shapes", "motion_kind"
]


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


@declared_by(DampingRow)
class DampingRowSection(Section):
    """Damping ratio of a mode at a speed, and its range; linear between the speeds of its rows, constant beyond."""

    def _check(self) -> None:
        if self.speed_rad_s is not None and self.speed_rpm is not None:
            refuse_both_units("speed_rad_s", "speed_rpm")
        lowest, highest = (self.ratio if bound is None else bound for bound in (self.lowest, self.highest))
        if not lowest <= self.ratio <= highest:
            raise refused(("ratio",), f"{self.ratio:g} in a range from {lowest:g} to {highest:g}", "lowest <= ratio <= highest")


def _check_rows(sections: list[DampingRowSection]) -> list[DampingRowSection]:
    rows = [si_form(DampingRow, section) for section in sections]
    places = [(row.mode, row.speed) for row in rows]
    for number, (mode, speed) in enumerate(places):
        others = [other for each, other in places[:number] if each == mode]
        if speed in others or (others and None in (speed, *others)):
            raise refused((number,), f"mode {mode} in several rows", "each at another speed, by speed_rad_s or speed_rpm")
    if all(mode for mode, _ in places):
        raise refused((), "no row of mode 0", "also one, which all other modes have")
    return sections


DampingRows = Annotated[list[DampingRowSection], Field(min_length=1), AfterValidator(_check_rows)]
DampingRatio: Any = or_section(DampingNumber, DampingSection, DampingRows)


@declared_by(Scene)
class SceneEntry(Section):
    """One scene of scenes.yaml; with `vary` or `designs` a family, many scenes that differ in some numbers."""

    base: Name | LeftOut = left_out("Scene of this file that gives what is left out; null leaves out a key that it has")
    tip_line: TipLine | LeftOut = left_out("Line of the contact nodes; by default structure.boundary.tip_line")
    casing: CasingSection
    lining: LiningSection | LeftOut = left_out("Abradable lining; the casing is bare without it")
    friction: FrictionSection | LeftOut = left_out("Friction at the tip")
    rotor: RotorSection | LeftOut = left_out("All blades in one casing; a single blade without it")
    damping_ratio: DampingRatio = Field(
        default=0.0005, description="Damping ratio; a table over frequency, or by mode and speed"
    )
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
        elif isinstance(damping, list):
            damping = tuple(si_form(DampingRow, row) for row in damping)
        parts = {"lining": lining, "friction": friction, "rotor": rotor, "damping_ratio": damping}
        return si_form(Scene, self, casing=self.casing.casing(), **parts)


class Scenes(RootModel[ByName[SceneEntry]]):
    """scenes.yaml, contact scenes by name."""


def checked_scenes(file: Document, above: Document | None = None) -> tuple[Document, dict[str, SceneEntry]]:
    """Scenes of a file with changes `above`, each with what its base gives it: content with its lines, and checked.

    Raises ConfigError for all that is wrong.
    """
    document, refused_bases = completed(file, above, "scene", ("base",))
    refusals = ConfigRefusals()
    # of a file in which all have such bases nothing is left
    checked = refusals.of(document.check, Scenes) if document.content or not file.content else None
    refusals.of(refused_bases.tell)
    refusals.tell()
    assert checked
    return document, checked.root
