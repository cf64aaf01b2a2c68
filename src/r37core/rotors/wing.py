"""Whole rotors as a wing."""

from __future__ import annotations

from r37core.plans.wing import Wing

from .captions import CAPTIONS
from .plan import remarks, targets

WING = Wing(name="rotors", targets=targets, remarks=remarks, captions=CAPTIONS)
