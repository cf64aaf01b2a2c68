"""Files for other programs as an extension."""

from r37core.plans.extension import Extension

from .plan import exported_speeds_are_run, targets
from .section import SECTION

EXTENSION = Extension(
    name="exports",
    section=SECTION,
    checks=(exported_speeds_are_run,),
    targets=targets,
    look_at="<results>/exports",
    made_on_request=True,
)
