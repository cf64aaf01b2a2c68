"""Units that people read beside those of the SI."""

from __future__ import annotations

import math

RPM = 30.0 / math.pi
"""Revolutions per minute of one rad/s."""

RAD_S = {"rad/s": 1.0, "rpm": math.pi / 30.0}
"""Angular speed (rad/s) of one of each unit that speeds may be given in."""
