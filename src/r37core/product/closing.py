"""What a run says of each wing when it ends: what was found, and the file to look at first."""

from __future__ import annotations

from contextlib import suppress
from importlib import import_module
from pathlib import Path

from r37core.config import Settings
from r37core.io import InputFileError
from r37core.plans.sweep_plan import Sweep
from r37core.plans.wing import Wing

from .targets import files_of
from .wings import WINGS

_FIRST = (".html", ".png", ".csv")
"""Suffixes of files that a person opens, the best first."""


def lines_of_wings(settings: Settings, began: float) -> list[str]:
    """A line for each wing that has made something since `began` (time in s, as file times are)."""
    lines = (line_of_wing(wing, Sweep(settings), settings.results, began) for wing in WINGS)
    return [line for line in lines if line]


def line_of_wing(wing: Wing, sweep: Sweep, results: Path, began: float) -> str:
    """What a wing has found, in the folder `results`, and where to look; empty where all that it made is older."""
    files = [results / file.removeprefix("<results>/") for file in files_of(wing, sweep)]
    made = [file for file in files if file.exists() and file.stat().st_mtime >= began]
    if not made:
        return ""
    closing = f"{len(made)} file{'s' * (len(made) > 1)} made"
    if wing.closing:
        module, name = f"r37core.{wing.closing}".rsplit(".", 1)
        # a file that cannot be read, or lacks a column, is no failure of the run that has ended: what reads it next refuses it
        with suppress(InputFileError, KeyError):
            closing = getattr(import_module(module), name)(results)
    return f"{wing.name}: {closing}; look at {_look_at(wing, files, results)}"


def _look_at(wing: Wing, files: list[Path], results: Path) -> Path:
    if wing.look_at:
        return results / wing.look_at.removeprefix("<results>/")
    order = {suffix: place for place, suffix in enumerate(_FIRST)}
    return min((file for file in files if file.exists()), key=lambda file: order.get(file.suffix, len(order)))
