"""Tolerances as an extension."""

from __future__ import annotations

from r37core.plans.extension import Extension

from .captions import CAPTIONS
from .checks import members_can_be_drawn, members_of_the_study_are_possible
from .plan import FOLDER, SAMPLING, remarks, simulated, targets
from .section import ToleranceSection

EXTENSION = Extension(
    name=FOLDER,
    section=(ToleranceSection, ToleranceSection()),
    checks=(members_can_be_drawn, members_of_the_study_are_possible),
    sampling=SAMPLING,
    simulated=simulated,
    targets=targets,
    remarks=remarks,
    captions=CAPTIONS,
    closing="tolerances.closing.closing",
)
