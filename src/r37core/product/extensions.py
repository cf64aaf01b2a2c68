"""The registry of the extensions: a capability is one folder of this package, one file of rules, and one line here."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from r37core.config import Settings
from r37core.plans.extension import Extension
from r37core.plans.samples import Beside, Sampling

_FOLDERS = (
    "exports",
    "shapes",
    "signals",
    "run_ups",
    "rotors",
    "designs",
    "tolerances",
    "search",
    "estimate",
    "tradeoff",
    "stability",
)
"""Folders of the extensions, in the order of their sections in docs/configuration.md."""

EXTENSIONS: tuple[Extension, ...] = tuple(import_module(f"r37core.{folder}.extension").EXTENSION for folder in _FOLDERS)
"""All extensions."""


def beside(settings: Settings, results: Path | None = None) -> Beside:
    """Samples of each extension that has some, by the folder of its results; `results`: in place of the workflow's."""
    return Beside(
        {extension.name: dict(extension.sampling.samples(settings)) for extension in EXTENSIONS if extension.sampling},
        later={
            extension.name: extension.later(settings, results or settings.results)
            for extension in EXTENSIONS
            if extension.later
        },
    )


def sampling_of(settings: Settings) -> Sampling | None:
    """Sampling of the extension whose members this run has, if any. Tables have ranges of one sample."""
    return next(
        (extension.sampling for extension in EXTENSIONS if extension.sampling and extension.sampling.samples(settings)), None
    )
