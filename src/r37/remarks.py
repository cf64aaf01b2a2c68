"""What calls remark on: warnings that point at the line of the caller."""

from __future__ import annotations

import warnings
from collections.abc import Iterable

from r37core.config import Settings
from r37core.config.remarks import remarks_on_input, remarks_on_points


def remarks_of(settings: Settings) -> list[str]:
    """What a run would remark on."""
    return [*remarks_on_input(settings), *remarks_on_points(settings)]


def tell(remarks: Iterable[str]) -> None:
    """Warn the caller of a call of r37, whose function's function calls this."""
    for remark in remarks:
        warnings.warn(remark, stacklevel=5)
