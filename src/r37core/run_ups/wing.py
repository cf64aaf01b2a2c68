"""Run-ups as a wing."""

from __future__ import annotations

from r37core.plans.wing import Wing

from .captions import CAPTIONS
from .checks import no_coriolis, no_rotors, run_ups_can_be_done, slowest_speeds_fit_in_memory
from .plan import remarks, simulated, targets
from .section import RUN_UP_SECTION

WING = Wing(
    name="run_ups",
    section=RUN_UP_SECTION,
    checks=(run_ups_can_be_done, slowest_speeds_fit_in_memory, no_coriolis, no_rotors),
    simulated=simulated,
    targets=targets,
    remarks=remarks,
    captions=CAPTIONS,
)
