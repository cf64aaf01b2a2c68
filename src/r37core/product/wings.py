"""The registry of the wings: each capability is one folder of this package, one file of rules, and one line here."""

from __future__ import annotations

from importlib import import_module

from r37core.plans.wing import Wing

_FOLDERS = (
    "exports",
    "shapes",
    "signals",
    "run_ups",
    "rotors",
    "designs",
    "tolerances",
    "search",
)
"""In the order of their sections in docs/configuration.md."""

WINGS: tuple[Wing, ...] = tuple(import_module(f"r37core.{folder}.wing").WING for folder in _FOLDERS)
"""All of them."""
