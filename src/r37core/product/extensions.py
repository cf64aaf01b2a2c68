"""The registry of the extensions: each capability is one folder of this package, one file of rules, and one line here."""

from __future__ import annotations

from importlib import import_module

from r37core.plans.extension import Extension

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
"""In the order of their sections in docs/configuration.md."""

EXTENSIONS: tuple[Extension, ...] = tuple(import_module(f"r37core.{folder}.extension").EXTENSION for folder in _FOLDERS)
"""All of them."""
