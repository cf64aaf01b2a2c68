"""Keys of blades.yaml that change a shape: sweep, lean, stagger, camber, chord and thickness."""

from typing import Annotated

from pydantic import Field

from .section import FileName, LeftOut, Section, left_out, refused
from .section_laws import Angles, Shares
from .varied import is_family

SHIFTS = ("stacking_table", "sweep_lean", "chordwise_sweep_deg")
"""Keys of the ways to give sweep and lean, of which a blade has at most one."""

SHARES = ("sweep_percent", "lean_percent")
"""Keys that keep a share of a table of sweep and lean."""

TableShare = Annotated[float, Field(ge=-1000, le=1000)]


class SweepLean(Section):
    """One row of sweep and lean."""

    span_percent: float = Field(ge=0, le=100, description="Position from the hub (0) to the tip (100)")
    sweep_cm: float = Field(ge=-100, le=100, description="Sweep, positive downstream")
    lean_deg: float = Field(gt=-90, lt=90, description="Lean, positive in the direction of rotation")


class ShapeKeys(Section):
    """Changes of profiles or sections, with at most one way to give sweep and lean."""

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

    def _check(self) -> None:
        is_family(self)
        shifts = [key for key in SHIFTS if getattr(self, key) is not None]
        if len(shifts) > 1:
            raise refused((), " and ".join(shifts), f"at most one of {', '.join(SHIFTS)}")
