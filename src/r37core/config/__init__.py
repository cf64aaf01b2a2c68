"""Configuration: YAML files checked by models, and the settings made of them."""

from .blades import BladeSettings
from .declaring import si_fields, si_form
from .document import ConfigError, Document, command_line_document, read_document
from .section import plain
from .settings import (
    Settings,
    blades_named,
    checked_scene,
    contact_of_blades,
    level_errors,
    operating_range,
    scenes_named,
    varied_settings,
)

__all__ = [
    "BladeSettings",
    "ConfigError",
    "Document",
    "Settings",
    "blades_named",
    "checked_scene",
    "command_line_document",
    "contact_of_blades",
    "level_errors",
    "operating_range",
    "plain",
    "read_document",
    "scenes_named",
    "si_fields",
    "si_form",
    "varied_settings",
]
