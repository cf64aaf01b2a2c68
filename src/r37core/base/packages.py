"""Packages of the distribution that r37core does without: what they add to it, where they lie next to it.

Each has a module `registry` with dictionaries of dotted names, which are imported where they are used. So r37core imports
neither, and a copy without them computes the same.
"""

from functools import cache
from importlib import import_module
from pathlib import Path

OPTIONAL = ("r37imports", "r37studies")

PACKAGES = ("r37core", *OPTIONAL)
"""Packages whose code results follow from."""


@cache
def registered(subject: str) -> dict[str, str]:
    """Key -> dotted name of all that the registries have under a subject, such as BLADE_ENTRIES; empty without packages."""
    source = Path(__file__).parents[2]
    there = (package for package in OPTIONAL if (source / package / "registry.py").exists())
    registries = [import_module(f"{package}.registry") for package in there]
    return {key: name for registry in registries for key, name in getattr(registry, subject, {}).items()}
