"""Whole rotors as an extension."""

from __future__ import annotations

from r37core.plans.extension import Extension, Panel

from .captions import CAPTIONS
from .plan import joined_dataset, remarks, targets

EXTENSION = Extension(
    name="rotors",
    targets=targets,
    remarks=remarks,
    captions=CAPTIONS,
    closing="rotors.closing.closing",
    panel=Panel(joined_dataset, "rotors.panel.rotor_contents", "rotors/panel.js"),
)
