"""Files for other programs as an extension."""

from __future__ import annotations

from r37core.plans.extension import Extension

from .checks import exported_speeds_are_run
from .plan import targets
from .section import ExportSection

EXTENSION = Extension(
    name="exports",
    section=(ExportSection, ExportSection()),
    checks=(exported_speeds_are_run,),
    targets=targets,
    look_at="<results>/exports",
    on_request=True,
)
