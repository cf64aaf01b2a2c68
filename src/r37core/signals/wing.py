"""Time signals as a wing."""

from __future__ import annotations

from r37core.plans.wing import Wing

from .captions import CAPTIONS
from .checks import signals_have_runs
from .plan import simulated, targets
from .section import SignalSection

WING = Wing(
    name="signals",
    section=(SignalSection, SignalSection()),
    checks=(signals_have_runs,),
    simulated=simulated,
    targets=targets,
    captions=CAPTIONS,
    closing="signals.closing.closing",
)
