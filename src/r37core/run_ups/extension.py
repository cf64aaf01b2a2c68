"""Run-ups as an extension."""

from __future__ import annotations

from r37core.plans.extension import Extension

from .captions import CAPTIONS
from .checks import no_coriolis, no_rotors, run_ups_can_be_done, slowest_speeds_can_be_run
from .plan import remarks, simulated, targets
from .section import RUN_UP_SECTION

EXTENSION = Extension(
    name="run_ups",
    section=RUN_UP_SECTION,
    checks=(run_ups_can_be_done, slowest_speeds_can_be_run, no_coriolis, no_rotors),
    simulated=simulated,
    targets=targets,
    remarks=remarks,
    captions=CAPTIONS,
    closing="run_ups.closing.closing",
)
