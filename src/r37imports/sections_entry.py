"""Blades in blades.yaml that are given by a file of section curves."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from r37core.base.io import TextFileError
from r37core.config.blade_sections import CONTACT_IN_WORDS, KINEMATICS_IN_WORDS, Contact, Kinematics, MaterialSection
from r37core.config.blades import BladeEntry
from r37core.config.declaring import si_form
from r37core.config.section import FileName, LeftOut, Section, either, left_out, option, refused
from r37core.config.shape_keys import SECTION_KEYS, ShapeKeys
from r37core.fem.orientation import Orientation
from r37imports.refusal import ASKED, ImportRefused
from r37imports.sections import placed
from r37imports.sections.definition import SectionsDefinition
from r37imports.sections.placed import OWN, Meridians
from r37imports.sections.section_file import SectionFile, read_meridian, read_section_file
from r37imports.sections.turbogrid import UNIT, check_companion, companion_of, meridian_next_to

from .imported_entry import LengthUnit, Oriented

MeridianPoint = Annotated[list[Annotated[float, Field(ge=-100, le=100)]], Field(min_length=2, max_length=2)]


class EndSurface(Section):
    """Surface of revolution that cuts the blade: a cylinder or a cone."""

    one_of = (("radius_m", "cone_zr_m"),)

    radius_m: Annotated[float, Field(ge=1e-3, le=100)] | LeftOut = left_out("Radius of a cylinder")
    cone_zr_m: Annotated[list[MeridianPoint], Field(min_length=2, max_length=2)] | LeftOut = left_out(
        "Two points [z, r] of a cone's straight meridian"
    )

    def _check(self) -> None:
        if self.cone_zr_m is not None and self.cone_zr_m[0][0] == self.cone_zr_m[1][0]:
            raise refused("the same z twice", "two points [z, r] of different z", "cone_zr_m")

    def meridian(self) -> Meridians:
        """Points (z, r) of the surface (m)."""
        if self.cone_zr_m is not None:
            return tuple((z, r) for z, r in self.cone_zr_m)
        assert self.radius_m is not None
        return ((0.0, self.radius_m),)


End: Any = either(FileName, EndSurface)


def _end(which: str, other: str) -> Any:
    return left_out(
        f"Surface that cuts it, a file as {other}.curve, sections (the {which}), or ?; "
        f"by default the file's {other}, else sections"
    )


# sections have no arcs to change
_NO_ARCS = SECTION_KEYS[1:]
_VARIED = (*(key for key in BladeEntry.varied if not key.startswith(_NO_ARCS)), "sweep_lean", "length_unit")
_VARIED += ("hub.radius_m", "tip.radius_m")


class SectionsEntry(ShapeKeys, Oriented):
    """A blade given by section curves, meshed as one with profiles is; with `vary` or `designs` a family."""

    key = "sections"
    file_keys = ("sections", "hub", "tip")
    no_files = (OWN, ASKED)
    varied = _VARIED
    has_shape = True

    sections: FileName = option(".curve, .crv, .geomTurbo, or .csv with section, x, y, z")
    length_unit: LengthUnit | Literal["?"] = option("Unit, or ? to ask")  # type: ignore[assignment]
    rotation: Literal["positive", "negative", "?"] = option("Sense about rotor_axis, or ? to ask")
    hub: End | LeftOut = _end("first", "hub")
    tip: End | LeftOut = _end("last", "shroud")
    pressure_side: Literal["forward", "backward"] = option(
        "forward: the pressure side faces the rotation, as in a compressor", "forward"
    )
    material: MaterialSection
    contact: Contact = option(CONTACT_IN_WORDS, "patches")
    kinematics: Kinematics = option(KINEMATICS_IN_WORDS, "quadratic")

    def definition(self, name: str, root: Path, check_sense: bool) -> SectionsDefinition:
        """The blade's definition, of files from the folder `root`.

        Raises ImportRefused with the key to blame, TextFileError and BladeShapeError of the file of sections, OSError.
        """
        file = root / self.sections
        content = read_section_file(file)
        companion = companion_of(file) | ({UNIT: content.unit} if content.unit else {})
        orientation, answers = self._orientation(content, companion)
        if check_sense:
            placed.check_axis(content.sections, orientation)
        sections, lines = placed.placed_sections(content, orientation)
        definition = SectionsDefinition(name, sections, pressure_forward=self.pressure_side == "forward")
        placed.check_curves(definition, lines, check_sense)
        ends: dict[str, Any] = {}
        for key, included, number in (("hub", content.hub, 0), ("tip", content.tip, -1)):
            end = getattr(self, key)
            if end in (None, ASKED):
                beside = None if included is not None else meridian_next_to(file, key)
                end = str(Path(self.sections).with_name(beside)) if beside else included
            if getattr(self, key) == ASKED:
                answers[key] = f"{key}: {placed.fitting_end(end, definition.curves[number])}"
            ends[key] = end
        if answers:
            raise ImportRefused(f"found '{ASKED}'; what fits: {'; '.join(answers.values())}", next(iter(answers)))
        hub, tip = (placed.meridian_along(_meridian(key, ends[key], orientation, root), definition.curves) for key in ends)
        definition = replace(definition, hub=hub, tip=tip)
        placed.check_ends(definition, orientation, (key for key, end in ends.items() if isinstance(end, EndSurface)))
        if check_sense:
            placed.check_sections_sense(definition)
        return definition

    def _orientation(self, content: SectionFile, companion: Mapping[str, str]) -> tuple[Orientation, dict[str, str]]:
        """Unit and axes, and a line on each key that asks for what fits, which they have then.

        Raises ImportRefused where directions are parallel, no unit fits, or file or .inf next to it have others.
        """
        answers: dict[str, str] = {}
        known = si_form(
            Orientation,
            self,
            length_unit=1.0 if self.length_unit == ASKED else self.length_unit,
            rotation="positive" if self.rotation == ASKED else self.rotation,
        )
        if self.length_unit == ASKED:
            unit, answers["length_unit"] = placed.fitting_unit(content, known, companion.get(UNIT, "").lower())
            known = replace(known, length_unit=unit)
        check_companion(companion, known)
        if self.rotation == ASKED:
            rotation, answers["rotation"] = placed.fitting_rotation(content.sections, known)
            known = replace(known, rotation=rotation)
        return known, answers


def _meridian(key: str, end: EndSurface | np.ndarray | str | None, orientation: Orientation, root: Path) -> Meridians:
    """Meridian of hub or tip by a surface, points or a file; ImportRefused for a file that gives none."""
    if isinstance(end, EndSurface):
        return end.meridian()
    if end is None or (isinstance(end, str) and end == OWN):
        return None
    try:
        return placed.placed_meridian(read_meridian(root / end) if isinstance(end, str) else end, orientation)
    except TextFileError as error:
        raise ImportRefused(f"{end}:{error.line}: {error.reason}", key) from None
    except OSError as error:
        allowed = f"radius_m, cone_zr_m, a file as hub.curve, {OWN}, or {ASKED}"
        raise ImportRefused(f"{end} cannot be read: {error.strerror}; allowed: {allowed}", key) from None
