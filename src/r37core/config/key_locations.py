"""Where the values of a checked configuration stand, for what is found out about them later."""

from __future__ import annotations

from r37core.yaml_file import KeyPath

from .settings import Settings


def locations_of_keys(settings: Settings, blade: str) -> dict[str, str]:
    """Key of a blade's entry, or of the entry that its base has it from -> `file:line: blade.key`."""
    entry = settings.designs.entries[blade]
    if base := getattr(entry, "base", None):
        return locations_of_keys(settings, base)
    return {key: f"{settings.documents.blades.location((blade, key))}: {blade}.{key}" for key in type(entry).model_fields}


def location_of_contact(settings: Settings, blade: str) -> str:
    """Where stands what a blade's contact acts on, as `file:line: key`."""
    path: KeyPath = ("structure", "boundary", "contact")
    if settings.structure.boundary.contact is not None:
        return f"{settings.documents.config.location(path)}: {'.'.join(map(str, path))}"
    return f"{settings.documents.blades.location((blade, 'contact'))}: {blade}.contact"
