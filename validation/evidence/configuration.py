"""Configurations of the runs that the evidence is made from."""

from pathlib import Path
from typing import Any

from r37core.config import Settings, command_line_document, read_document
from r37core.config.document import Document
from r37core.config.reading import together
from r37core.product.extensions import read_settings


def overlay(root: Path, *files: str, **keys: Any) -> dict[str, Any]:
    """Content of overlays of config/, as `patches`, each on top of the one before, with `keys` on top of all."""
    overlays = (read_document(root, f"config/{name}.yaml") for name in files)
    return together(Document("validation", {}), [*overlays, command_line_document(keys)]).content


def settings_of(root: Path, **keys: Any) -> Settings:
    """Settings of the shipped configuration with some keys on top."""
    return read_settings(root, command_line_document(keys))
