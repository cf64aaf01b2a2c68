"""Whole rotors as a wing."""

from __future__ import annotations

from r37core.plans.wing import Wing

from .captions import CAPTIONS
from .checks import run_ups_have_single_blades
from .plan import remarks, targets

WING = Wing(name="rotors", checks=(run_ups_have_single_blades,), targets=targets, remarks=remarks, captions=CAPTIONS)
