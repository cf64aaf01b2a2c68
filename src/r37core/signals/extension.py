"""Time signals as an extension."""

from __future__ import annotations

from r37core.plans.extension import Extension

from .captions import CAPTIONS
from .checks import signals_have_runs
from .plan import simulated, targets
from .section import SignalSection

EXTENSION = Extension(
    name="signals",
    section=(SignalSection, SignalSection()),
    checks=(signals_have_runs,),
    simulated=simulated,
    targets=targets,
    captions=CAPTIONS,
    closing="signals.closing.closing",
)
