"""scenes.yaml: what the blade meets."""

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, RootModel

from r37core.contact.scene import DampingRow, DampingTable, Friction, Lining, Scene
from r37core.time_integration.rotor_blades import NO_ROTOR, refusal_of

from .casing_section import CasingSection
from .declaring import declared_by, section_of, si, si_fields
from .rotor_section import RotorSection
from .section import ByName, EachOnce, LeftOut, Name, Rpm, Section, Speed, check_table, either, left_out, option, refused
from .varied import FamilyKeys

TipLine = Literal["pressure_edge", "camber", "suction_edge"]
OF_ONE_BLADE = ("signal", "shapes", "motion_kind")
"""Results that a scene with a rotor cannot have."""

_HISTORIES = ("stress_history_speeds_rad_s", "stress_history_speeds_rpm")

Result = Literal[
    "spectrum", "signal", "stress", "static_stress", "fatigue", "wear", "energy", "casing", "shapes", "motion_kind"
]


@declared_by(Lining)
class LiningSection(Section):
    """The abradable lining in front of the casing."""

    # of the published model two ways, and the one of a contact length
    refuse_several = (("bar_width_m", "bar_area_m2", "contact_length_m"),)


FrictionSection: Any = section_of(Friction, "Friction at the tip.")

DampingNumber = Annotated[float, Field(ge=0, lt=1)]


@declared_by(DampingTable)
class DampingSection(Section):
    """Damping ratio over the mode's frequency at the speed of a run: linear, constant beyond the ends."""

    def _check(self) -> None:
        check_table(self, "frequencies_hz", "ratios")


@declared_by(DampingRow)
class DampingRowSection(Section):
    """Damping ratio of a mode at a speed, and its range; linear between the speeds of its rows, constant beyond."""

    refuse_several = (("speed_rad_s", "speed_rpm"),)

    def _check(self) -> None:
        lowest, highest = (self.ratio if bound is None else bound for bound in (self.lowest, self.highest))
        if not lowest <= self.ratio <= highest:
            raise refused(f"{self.ratio:g} in a range from {lowest:g} to {highest:g}", "lowest <= ratio <= highest", "ratio")


def _check_rows(sections: list[DampingRowSection]) -> list[DampingRowSection]:
    places = [(row.mode, row.speed) for row in map(si, sections)]
    for number, (mode, speed) in enumerate(places):
        others = [other for each, other in places[:number] if each == mode]
        if speed in others or (others and None in (speed, *others)):
            raise refused(f"mode {mode} in several rows", "each at another speed, by speed_rad_s or speed_rpm", number)
    if all(mode for mode, _ in places):
        raise refused("no row of mode 0", "also one, which all other modes have")
    return sections


DampingRows = Annotated[list[DampingRowSection], Field(min_length=1), AfterValidator(_check_rows)]
DampingRatio: Any = either(DampingNumber, DampingSection, rows=DampingRows)
"""One number, a law with keys of its own, of which there may be several, or rows."""


class SceneKeys(Section):
    """Keys of a scene that are its own: casing, lining, friction, blades, and the results that are kept."""

    base: Name | LeftOut = left_out("Scene of this file that gives what is left out; null leaves out a key that it has")
    tip_line: TipLine | LeftOut = left_out("Line of the contact nodes; by default structure.boundary.tip_line")
    casing: CasingSection
    lining: LiningSection | LeftOut = left_out("Abradable lining; the casing is bare without it")
    friction: FrictionSection | LeftOut = left_out("Friction at the tip")
    rotor: RotorSection | LeftOut = left_out("All blades in one casing; a single blade without it")
    damping_ratio: DampingRatio = option("Damping ratio; a table over frequency, or by mode and speed", 0.0005)
    revolutions: Annotated[int, Field(ge=1, le=20000)] | LeftOut = left_out(
        "Revolutions of a run, in place of the fidelity level's"
    )
    until: Literal["revolutions", "settled"] | LeftOut = left_out("End of a run, in place of the fidelity level's")
    results: EachOnce[Result] = option(
        "Kept results; static_stress adds the stress of rotation, fatigue compares stress with the Goodman line, "
        "casing keeps the waves of an elastic casing, motion_kind says whether the motion is chaotic",
        ["spectrum", "stress"],
        json_schema_extra={"uniqueItems": True},
    )
    stress_history_speeds_rad_s: EachOnce[Speed] = option(
        "Speeds at which the largest stress of every revolution is kept, as far as they are run", []
    )
    stress_history_speeds_rpm: EachOnce[Rpm] = option("The same speeds in revolutions per minute", [])

    def _check(self) -> None:
        lined, stressed = self.lining is not None, "stress" in self.results
        for results, possible, where in (
            (("wear",), lined, "in a scene with a lining"),
            (("casing",), self.casing.elastic, "in a scene whose casing has a ring or ring_modes"),
            (("shapes", "static_stress", "fatigue"), stressed, "with stress among the results"),
            (OF_ONE_BLADE, self.rotor is None, "in a scene without rotor: its results are of all blades together"),
        ):
            for result in results:
                if result in self.results and not possible:
                    raise refused(result, f"only {where}", "results")
        for key in _HISTORIES:
            if getattr(self, key) and not stressed:
                raise refused("speeds", "only with stress among the results", key)
        if self.casing.elastic and self.gap == "exact":
            raise refused(
                "exact with an elastic casing", "linear; the exact gap is that of a casing that keeps its shape", "gap"
            )
        if self.rotor is not None:
            self._check_rotor()

    def _check_rotor(self) -> None:
        refusal = refusal_of(self.scene())
        if refusal:
            raise refused("a rotor in this scene", refusal, "rotor")
        if self.until == "settled":
            raise refused("settled with a rotor", NO_ROTOR, "until")

    def scene(self) -> Scene:
        """The scene as the simulations take it."""
        return si(self)

    def stress_history_speeds(self) -> tuple[float, ...]:
        """Speeds (rad/s) at which the largest stress of every revolution is kept."""
        return si_fields((key, getattr(self, key)) for key in _HISTORIES)["stress_history_speeds"]


@declared_by(Scene)
class SceneEntry(FamilyKeys, SceneKeys):
    """One scene of scenes.yaml; with `vary` or `designs` a family, many scenes that differ in some numbers."""

    refuse_several = (*FamilyKeys.refuse_several, _HISTORIES)


class Scenes(RootModel[ByName[SceneEntry]]):
    """scenes.yaml, contact scenes by name."""
