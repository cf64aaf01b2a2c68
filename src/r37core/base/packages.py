"""Packages of the distribution that r37core does without: what they add to it, where they are installed.

Each has a module `registry` with dictionaries of dotted names, which are imported where they are used. So r37core imports
neither, and a copy without them computes the same.
"""

from functools import cache
from importlib import import_module
from importlib.util import find_spec

OPTIONAL = ("r37imports", "r37studies")

PACKAGES = ("r37core", *OPTIONAL)
"""Packages whose code results follow from."""


@cache
def registered(subject: str) -> dict[str, str]:
    """Key -> dotted name of all that the registries have under a subject, such as BLADE_ENTRIES; empty without packages."""
    registries = (import_module(f"{package}.registry") for package in OPTIONAL if _is_installed(package))
    return {key: name for registry in registries for key, name in getattr(registry, subject, {}).items()}


def _is_installed(package: str) -> bool:
    # a folder that holds nothing but compiled leftovers is a package, too
    return find_spec(package) is not None and find_spec(f"{package}.registry") is not None
