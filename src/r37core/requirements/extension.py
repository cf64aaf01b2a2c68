"""Requirements as an extension."""

from r37core.plans.extension import Extension, Panel

from .checks import can_be_judged, remarks
from .plan import targets, verdict
from .section import SECTION

EXTENSION = Extension(
    name="requirements",
    section=SECTION,
    checks=(can_be_judged,),
    targets=targets,
    verdict=verdict,
    remarks=remarks,
    closing="requirements.table.closing",
    panel=Panel(verdict, "requirements.panel.contents", "requirements/panel.js"),
)
