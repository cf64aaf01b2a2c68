"""How long a run is: its steps, the CPU time that they take, and how many of them a compiled call does."""

from __future__ import annotations

MOST_STEPS = 10**9
"""Of a run, all blades of a rotor together. Speeds that need more are refused: so many take the compiled engine minutes."""

STEPS_AT_ONCE = 1_000_000
"""In one compiled call, or those of a revolution where it has more. An interrupt is seen between two calls, within a second."""

SECONDS_PER_STEP = {"compiled": 1e-7, "reference": 5e-5}
"""CPU time (s) by engine, of a blade with eight contact nodes: the compiled one had 70 to 100 ns at any speed and level."""


def revolutions_at_once(steps_per_revolution: int) -> int:
    """Whole revolutions in about STEPS_AT_ONCE, at least one: where a run may be stopped with the same bits."""
    return max(STEPS_AT_ONCE // steps_per_revolution, 1)
