"""Dataclasses of the computations as tests want them: what a test does not name is the configuration's default."""

from collections.abc import Callable
from dataclasses import fields
from typing import Any

from r37core.config import si_fields
from r37core.config.config_file import Boundary, Interactions
from r37core.config.fidelity import TimeIntegration
from r37core.config.imported_entry import MeshEntry, SurfaceRule
from r37core.config.scenes import CasingSection, FrictionSection, LiningSection, SceneEntry
from r37core.contact import casing, scene
from r37core.exchange import orientation
from r37core.exchange.importing import source, where
from r37core.results import interactions
from r37core.rom import reduction_choice
from r37core.time_integration import integration_choice


def defaults_of(section) -> dict[str, Any]:
    """Fields, in SI units, that a section has when nothing is given."""
    return si_fields((key, field.default) for key, field in section.model_fields.items() if not field.is_required())


def _with_defaults(kind: type, section, **others: Any) -> Callable[..., Any]:
    names = [field.name for field in fields(kind)]
    found = {name: value for name, value in defaults_of(section).items() if name in names} | others

    def made(*values: Any, **named: Any) -> Any:
        return kind(**found | dict(zip(names, values, strict=False)) | named)

    return made


Casing = _with_defaults(casing.Casing, CasingSection)
Lining = _with_defaults(scene.Lining, LiningSection)
Friction = _with_defaults(scene.Friction, FrictionSection)
Scene = _with_defaults(scene.Scene, SceneEntry, lining=None, friction=None)
IntegrationChoice = _with_defaults(integration_choice.IntegrationChoice, TimeIntegration)
InteractionChoice = _with_defaults(interactions.InteractionChoice, Interactions)
BoundaryChoice = _with_defaults(reduction_choice.BoundaryChoice, Boundary, contact="points")
Orientation = _with_defaults(orientation.Orientation, MeshEntry)
MeshSource = _with_defaults(source.MeshSource, MeshEntry)
MatricesSource = _with_defaults(source.MatricesSource, MeshEntry, mass_unit="kg", stiffness_unit="N/m")
Where = _with_defaults(where.Where, SurfaceRule)
