"""The registry of the wings: each capability is one folder of this package, one file of rules, and one line here."""

from __future__ import annotations

from r37core.designs.wing import DESIGNS
from r37core.exports.wing import EXPORTS
from r37core.plans.wing import Wing
from r37core.run_ups.wing import RUN_UPS
from r37core.shapes.wing import SHAPES
from r37core.signals.wing import SIGNALS

WINGS: tuple[Wing, ...] = (EXPORTS, SHAPES, SIGNALS, RUN_UPS, DESIGNS)
"""In the order of their sections in docs/configuration.md."""
