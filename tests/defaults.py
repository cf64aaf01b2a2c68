"""Dataclasses of the computations as tests want them: what neither a test nor the dataclass names is simple."""

from collections.abc import Callable
from dataclasses import fields
from typing import Any

from r37core.contact import scene
from r37core.contact.casing import Casing
from r37core.contact.scene import Friction, Lining
from r37core.fem.orientation import Orientation
from r37core.results.interaction_choice import InteractionChoice
from r37core.rom import reduction_choice
from r37core.time_integration.integration_choice import IntegrationChoice

__all__ = ["Casing", "Friction", "IntegrationChoice", "InteractionChoice", "Lining", "Orientation"]


def with_defaults(kind: type, **others: Any) -> Callable[..., Any]:
    """A dataclass of which the `others` need not be given."""
    names = [field.name for field in fields(kind)]

    def made(*values: Any, **named: Any) -> Any:
        return kind(**others | dict(zip(names, values, strict=False)) | named)

    return made


Scene = with_defaults(scene.Scene, lining=None, friction=None, damping_ratio=0.0005)
BoundaryChoice = with_defaults(reduction_choice.BoundaryChoice, contact="points")
