"""What no file alone can check of families of designs."""

from __future__ import annotations

from r37core.blade.definition import BladeDefinition
from r37core.config import Settings

from .plan import families


def families_have_shapes(settings: Settings) -> None:
    """No family is of an imported blade: what is compared of designs needs their shape."""
    for name, family in families(settings).items():
        members = [settings.blades[design] for design in family.designs if design in settings.blades]
        if any(not isinstance(blade.definition, BladeDefinition) for blade in members):
            raise settings.documents.blades.refusal(
                (name,), "a family of an imported blade", "families of blades with profiles"
            )
