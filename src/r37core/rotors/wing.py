"""Whole rotors as a wing."""

from __future__ import annotations

from r37core.plans.wing import Panel, Wing

from .captions import CAPTIONS
from .plan import joined_dataset, remarks, targets

WING = Wing(
    name="rotors",
    targets=targets,
    remarks=remarks,
    captions=CAPTIONS,
    closing="rotors.closing.closing",
    panel=Panel(joined_dataset, "rotors.panel.rotor_contents", "rotors/panel.js"),
)
