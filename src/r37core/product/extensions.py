"""The registry of the extensions: a capability is one folder of this package, one file of rules, and one line here."""

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
    "second_motions",
    "rotors",
    "designs",
    "requirements",
    "tolerances",
    "search",
    "estimate",
    "tradeoff",
    "stability",
)
"""Folders of the extensions, in the order of their sections in docs/configuration.md."""

EXTENSIONS: tuple[Extension, ...] = tuple(import_module(f"r37core.{folder}.plan").EXTENSION for folder in _FOLDERS)
"""All extensions."""


def beside(settings: Settings, results: Path | None = None) -> Beside:
    """Samples of each extension that has some, by the folder of its results; `results`: in place of the workflow's."""
    known = {each.name: dict(each.sampling.samples(settings)) for each in EXTENSIONS if each.sampling}
    later = {each.name: each.later(settings, results or settings.results) for each in EXTENSIONS if each.later}
    return Beside(known, later)


def sampling_of(settings: Settings) -> Sampling | None:
    """Sampling of the extension whose members this run has, if any. Tables have ranges of one sample."""
    several = (extension.sampling for extension in EXTENSIONS if extension.sampling)
    return next((sampling for sampling in several if sampling.samples(settings)), None)
