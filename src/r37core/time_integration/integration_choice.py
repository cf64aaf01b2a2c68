"""Numbers of a time integration."""

from __future__ import annotations

from dataclasses import dataclass

LARGEST_TABLE = 2**30
"""Bytes of the casing's shape at every step of a revolution."""


@dataclass(frozen=True)
class IntegrationChoice:
    """Numbers of the time integration: largest time step (s), revolutions, samples per revolution, and what is recorded.

    `snapshots_per_revolution` states are recorded in each of the last `snapshot_revolutions`; `jumps`: whether free flight is jumped over or stepped through; `highest_frequency` (Hz): faster
    modes are not stepped; `static_above`: nor are, with exact_modal, modes with a larger product of angular frequency and step,
    and all that are not stepped follow the contact forces statically; `shorten`: whether an unstable step is shortened, or
    refused; `steps_per_sample`: given where a run keeps them over many speeds; `integrator`: one of
    r37core.time_integration.integrators; `engine`: the compiled time integration, or the plain one of
    r37core.time_integration.reference.
    """

    time_step: float
    revolutions: int
    samples_per_revolution: int
    integrator: str
    engine: str
    snapshots_per_revolution: int = 0
    snapshot_revolutions: int = 0
    jumps: bool = True
    highest_frequency: float = float("inf")
    static_above: float = 1.0
    shorten: bool = False
    steps_per_sample: int | None = None

    @property
    def revolutions_in_statistic(self) -> int:
        """Revolutions of the last half of the run, which rms and the statistic of the stress are taken over."""
        return self.revolutions - self.revolutions // 2
