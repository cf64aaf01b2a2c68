"""The files of one blade's structure for calls, from the user's cache or made when they are asked for."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from r37core.config import ConfigError, Settings
from r37core.machine_code.kept import named_folder, writable_folder
from r37core.sweep.recipe import recipes, structure_attributes

from .jobs import parallel_results


def structure_file(settings: Settings, blade: str, stage: str, tip_line: str | None = None) -> Path:
    """The file of a stage, with the numbers that one thread of linear algebra gives. Raises what making it raises."""
    made = recipes(settings, blade, {stage: tip_line})[stage]
    (file,) = parallel_results([partial(made.file, cache_folder(), structure_attributes(settings, blade))], 1)
    return file


def cache_folder() -> Path:
    """The user's cache folder. ConfigError if it cannot be written."""
    try:
        return writable_folder()
    except OSError as error:
        refusal = f"R37_CACHE: found the cache folder {named_folder()}, which cannot be written ({error.strerror})"
        raise ConfigError(f"{refusal}; allowed: a folder that can") from None
