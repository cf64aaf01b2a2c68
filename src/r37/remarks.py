"""What calls remark on: warnings that point at the line of the caller."""

from __future__ import annotations

import inspect
import os
import warnings
from collections.abc import Iterable
from pathlib import Path

from r37core.config import Settings
from r37core.config.remarks import remarks_on_input, remarks_on_points

_PACKAGE = str(Path(__file__).parent) + os.sep


def remarks_of(settings: Settings) -> list[str]:
    """What a run would remark on."""
    return [*remarks_on_input(settings), *remarks_on_points(settings)]


def tell(remarks: Iterable[str]) -> None:
    """Warn whoever has called r37: each remark points at the innermost line outside this package."""
    level, frame = 1, inspect.currentframe()
    while frame and frame.f_code.co_filename.startswith(_PACKAGE):
        level, frame = level + 1, frame.f_back
    for remark in remarks:
        warnings.warn(remark, stacklevel=level)
