"""Keys of blades.yaml that change the profiles: a number, its values at hub and tip, or a table over the span."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from pydantic import Discriminator, Field, Tag

from r37core.base.units import si_name
from r37core.blade.profile import BladeShapeError, ProfileParameters
from r37core.blade.profile_tables import check_spans
from r37core.blade.section_changes import SectionChangeError, SpanLaw, changed_profiles

from .section import Section

SECTION_KEYS = ("stagger_deg", "camber_deg", "chord_percent", "thickness_percent")
"""Keys of the changes of a blade's profiles."""

END_KEYS = tuple(f"{key}.{end}" for key in SECTION_KEYS for end in ("hub", "tip"))
"""Keys of their values at hub and tip."""

_Span = Annotated[float, Field(ge=0, le=100, description="Position from the hub (0) to the tip (100)")]
Angle = Annotated[float, Field(ge=-90, le=90)]
Share = Annotated[float, Field(ge=10, le=1000)]


def neutral_value(key: str) -> float:
    """Value of a number of a blade's shape that changes nothing: the whole of a share, no angle or length added."""
    return 100.0 if key.split(".")[0].endswith("_percent") else 0.0


class AngleEnds(Section):
    """An added angle, linear from hub to tip."""

    hub: Angle = Field(default=0.0, description="Value at the hub")
    tip: Angle = Field(default=0.0, description="Value at the tip")


class ShareEnds(Section):
    """A share that is kept, linear from hub to tip."""

    hub: Share = Field(default=100.0, description="Value at the hub")
    tip: Share = Field(default=100.0, description="Value at the tip")


class AngleRow(Section):
    """An added angle at one span."""

    span_percent: _Span
    value: Angle = Field(description="Value at this position")


class ShareRow(Section):
    """A share that is kept at one span."""

    span_percent: _Span
    value: Share = Field(description="Value at this position")


def _form(law: Any) -> str:
    if isinstance(law, list | tuple):
        return "table"
    return "ends" if isinstance(law, dict | AngleEnds | ShareEnds) else "number"


Angles = Annotated[
    Annotated[Angle, Tag("number")]
    | Annotated[AngleEnds, Tag("ends")]
    | Annotated[list[AngleRow], Field(min_length=2), Tag("table")],
    Discriminator(_form),
]
Shares = Annotated[
    Annotated[Share, Tag("number")]
    | Annotated[ShareEnds, Tag("ends")]
    | Annotated[list[ShareRow], Field(min_length=2), Tag("table")],
    Discriminator(_form),
]


def section_laws(entry: Section) -> dict[str, SpanLaw]:
    """Laws of an entry by key, in the SI. Raises SectionChangeError for a table whose spans do not rise from 0 to 100%."""
    laws = {key: getattr(entry, key) for key in SECTION_KEYS}
    return {key: span_law(key, law) for key, law in laws.items() if law is not None}


def span_law(key: str, law: Any) -> SpanLaw:
    """A checked value of one of SECTION_KEYS in the SI. Raises as section_laws."""
    factor = si_name(key)[1] or 1.0
    if isinstance(law, AngleEnds | ShareEnds):
        return SpanLaw.linear(law.hub * factor, law.tip * factor)
    if not isinstance(law, list):
        return SpanLaw.constant(law * factor)
    spans = tuple(0.01 * row.span_percent for row in law)
    try:
        check_spans(spans)
    except BladeShapeError as error:
        raise SectionChangeError(str(error), [si_name(key)[0]]) from None
    return SpanLaw(spans, tuple(row.value * factor for row in law))


def profiles_by_laws(profiles: Sequence[ProfileParameters], laws: Mapping[str, SpanLaw]) -> tuple[ProfileParameters, ...]:
    """The profiles, changed by laws of SECTION_KEYS. Raises SectionChangeError for impossible ones and for those that cross."""
    return changed_profiles(profiles, {si_name(key)[0]: law for key, law in laws.items()})


def changed_keys(error: SectionChangeError) -> list[str]:
    """Keys of the changes that an error is of."""
    return [key for key in SECTION_KEYS if si_name(key)[0] in error.names]
