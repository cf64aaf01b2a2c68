"""Entries of configuration files with some values changed. Light: the workflow imports it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def changed(entry: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """A copy of a scene's entry with the values at dotted paths replaced."""
    result: dict[str, Any] = {key: dict(value) if isinstance(value, Mapping) else value for key, value in entry.items()}
    for path, value in changes.items():
        *parents, last = path.split(".")
        target = result
        for parent in parents:
            target = target[parent]
        target[last] = value
    return result
