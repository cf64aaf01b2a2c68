"""Configurations of the runs that the evidence is made from."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from r37core.config import Settings, command_line_document
from r37core.product.reading import read_settings
from r37core.yaml_file import load_yaml


def overlay(root: Path, *files: str, **keys: Any) -> dict[str, Any]:
    """Content of overlays of config/, as `patches`, each on top of the one before, with `keys` on top of all."""
    changes: dict[str, Any] = {}
    for content in (*(load_yaml(root / f"config/{name}.yaml") for name in files), keys):
        changes = _merged(changes, content)
    return changes


def _merged(below: dict[str, Any], above: dict[str, Any]) -> dict[str, Any]:
    both = {
        key: _merged(below[key], value) if isinstance(value, dict) and isinstance(below.get(key), dict) else value
        for key, value in above.items()
    }
    return {**below, **both}


def settings_of(root: Path, **keys: Any) -> Settings:
    """Settings of the shipped configuration with some keys on top."""
    return read_settings(root, command_line_document(keys))
