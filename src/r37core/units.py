"""Units that people read beside those of the SI."""

from __future__ import annotations

import math

RPM = 30.0 / math.pi
"""Revolutions per minute of one rad/s."""
