"""Keys of blades.yaml that change a shape: sweep, lean, stagger, camber, chord and thickness."""

from typing import Annotated, Any

from pydantic import Field, create_model

from r37core.base.units import si_name
from r37core.blade.definition import Shape
from r37core.blade.profile import BladeShapeError
from r37core.blade.profile_tables import check_spans
from r37core.blade.section_changes import SectionChangeError, SpanLaw
from r37core.mesh.disc import Disc

from .declaring import section_of
from .section import FileName, LeftOut, Section, either, left_out, option
from .varied import FamilyKeys

SECTION_KEYS = ("stagger_deg", "camber_deg", "chord_percent", "thickness_percent")
"""Keys of the changes of a blade's profiles."""

END_KEYS = tuple(f"{key}.{end}" for key in SECTION_KEYS for end in ("hub", "tip"))
"""Keys of their values at hub and tip."""


def neutral_value(key: str) -> float:
    """Value of a number of a blade's shape that changes nothing: the whole of a share, no angle or length added."""
    return 100.0 if key.split(".")[0].endswith("_percent") else 0.0


class Ends(Section):
    """Values at hub and tip, linear between them."""


def _law(name: str, purpose: str, value: Any, neutral: float) -> Any:
    """Type of a key: a number of the kind `value`, its values at hub and tip, where `neutral` changes nothing, or a table."""
    end_fields: dict[str, Any] = {end: (value, option(f"Value at the {end}", neutral)) for end in ("hub", "tip")}
    ends = create_model(f"{name}Ends", __base__=Ends, __doc__=f"{purpose}, linear from hub to tip.", **end_fields)
    row = create_model(
        f"{name}Row",
        __base__=Section,
        __doc__=f"{purpose} at one span.",
        span_percent=Annotated[float, Field(ge=0, le=100, description="Position from the hub (0) to the tip (100)")],
        value=(value, option("Value at this position")),
    )
    return either(value, ends, rows=Annotated[list[row], Field(min_length=2)])  # type: ignore[valid-type]


Angles: Any = _law("Angle", "An added angle", Annotated[float, Field(ge=-90, le=90)], 0.0)
Shares: Any = _law("Share", "A share that is kept", Annotated[float, Field(ge=10, le=1000)], 100.0)


def changed_shape(shape: Shape, entry: Section) -> Shape:
    """The shape with the changes of an entry.

    Raises SectionChangeError for impossible profiles, for those that cross, and for a table whose spans do not rise from 0 to
    100%.
    """
    laws = {key: law for key in SECTION_KEYS if (law := getattr(entry, key)) is not None}
    return shape.changed({si_name(key)[0]: _span_law(law, *si_name(key)) for key, law in laws.items()})


def _span_law(law: Any, name: str, unit: float | None) -> SpanLaw:
    """A checked value of one of SECTION_KEYS in the SI. Raises SectionChangeError."""
    factor = unit or 1.0
    if isinstance(law, Ends):
        return SpanLaw.linear(law.hub * factor, law.tip * factor)
    if not isinstance(law, list):
        return SpanLaw.constant(law * factor)
    spans = tuple(0.01 * row.span_percent for row in law)
    try:
        check_spans(spans)
    except BladeShapeError as error:
        raise SectionChangeError(str(error), [name]) from None
    return SpanLaw(spans, tuple(row.value * factor for row in law))


def changed_keys(error: SectionChangeError) -> list[str]:
    """Keys of the changes that an error is of."""
    return [key for key in SECTION_KEYS if si_name(key)[0] in error.names]


SHIFTS = ("stacking_table", "sweep_lean", "chordwise_sweep_deg")
"""Keys of the ways to give sweep and lean, of which a blade has at most one."""

SHARES = ("sweep_percent", "lean_percent")
"""Keys that keep a share of a table of sweep and lean."""

TableShare = Annotated[float, Field(ge=-1000, le=1000)]


class SweepLean(Section):
    """One row of sweep and lean."""

    span_percent: float = option("Position from the hub (0) to the tip (100)", ge=0, le=100)
    sweep_cm: float = option("Sweep, positive downstream", ge=-100, le=100)
    lean_deg: float = option("Lean, positive in the direction of rotation", gt=-90, lt=90)


DiscSection: Any = section_of(Disc, "A disc clamped at its bore, on which one blade rubs and the others are carried.")


class ShapeKeys(FamilyKeys):
    """Changes of profiles or sections, with at most one way to give sweep and lean."""

    refuse_several = (SHIFTS, *FamilyKeys.refuse_several)

    stacking_table: FileName | LeftOut = left_out("Table (CSV) of sweep and lean with a column `blade`")
    sweep_lean: Annotated[list[SweepLean], Field(min_length=2)] | LeftOut = left_out(
        "Sweep and lean in this file, one entry per row"
    )
    chordwise_sweep_deg: Annotated[float, Field(gt=-60, lt=60)] | LeftOut = left_out(
        "Constant chordwise sweep in place of a table, positive forward"
    )
    sweep_percent: TableShare | LeftOut = left_out("Share of the sweep in the table that is kept")
    lean_percent: TableShare | LeftOut = left_out("Share of the lean in the table that is kept")
    stagger_deg: Angles | LeftOut = left_out(
        "Angle added to the stagger: a number, values at hub and tip, or a table over the span"
    )
    camber_deg: Angles | LeftOut = left_out("Angle added to the camber kappa_ic - kappa_oc")
    chord_percent: Shares | LeftOut = left_out("Share of the chord that is kept, on the same cones")
    thickness_percent: Shares | LeftOut = left_out("Share of all thicknesses that is kept")
    disc: DiscSection | LeftOut = left_out("Disc under the root; by default that of the base, without one the root is clamped")
