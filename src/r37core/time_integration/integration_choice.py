"""Numbers of a time integration."""

from dataclasses import dataclass, replace
from typing import Annotated, Self

from r37core.base.declared import Key

from .integrators import CENTRAL_DIFFERENCE, EXACT_MODAL, INTEGRATORS

PUBLISHED_REVOLUTIONS = 200
"""Length of the benchmark's runs. Those that go on until they settle have their lobes, and their statistic, from it."""

MOST_STEPS = 10**9
"""Largest number of steps of a run, all blades together; more are refused, as the compiled engine takes minutes for them."""

STEPS_AT_ONCE = 1_000_000
"""Steps in one compiled call, at least a revolution. An interrupt is seen between two calls, within a second."""

MARKED = 10
"""Revolutions from one mark of a run's totals to the next: how closely it is known when a run leaves the model's limits."""

HEATED = 20
"""Revolutions over which the power of the friction is a mean."""

SECONDS_PER_STEP = 1e-7
"""CPU time (s) of a step of a blade with eight contact nodes, which was 70 to 100 ns at any speed and level."""


def revolutions_at_once(steps_per_revolution: int) -> int:
    """Whole revolutions in about STEPS_AT_ONCE, at least one: where a run may be stopped with the same bits."""
    return max(STEPS_AT_ONCE // steps_per_revolution, 1)


LARGEST_TABLE = 2**28
"""Bytes of the casing's shape at every step of a revolution: every core has one, and a revolution can take no interrupt."""


@dataclass(frozen=True)
class IntegrationChoice:
    """Numbers of the time integration: largest time step (s), revolutions, samples per revolution, and what is recorded.

    `snapshots_per_revolution` states are recorded in each of the last `snapshot_revolutions`; `static_above`: with
    exact_modal, modes with a larger product of angular frequency and step are not stepped either, and all that are not stepped
    follow the contact forces statically; `shorten`: whether an unstable step is shortened, or refused; `steps_per_sample`:
    given where a run keeps them over many speeds. `until_settled`: whether a run ends as soon as it has settled
    (time_integration.settling).
    """

    time_step: float
    revolutions: Annotated[int, Key("Length of a run, at most where it ends as it has settled", ge=2, le=20000)]
    samples_per_revolution: int
    integrator: Annotated[
        str, Key("Scheme; exact_modal is exact between contacts, with fast modes static and forces at t_n", one_of=INTEGRATORS)
    ] = CENTRAL_DIFFERENCE
    snapshots_per_revolution: int = 0
    snapshot_revolutions: int = 0
    highest_frequency: Annotated[
        float, Key("Highest stepped frequency; faster modes are static with exact_modal, else left out", "_hz", ge=100, le=1e12)
    ] = float("inf")
    static_above: float = 1.0
    shorten: bool = False
    steps_per_sample: int | None = None
    until_settled: Annotated[
        bool,
        Key(
            "End of a run: after its revolutions, or as soon as 50 of them bring no wear and no change of the motion",
            name="until",
            words={"revolutions": False, "settled": True},
        ),
    ] = False

    @property
    def second_order(self) -> bool:
        """True where the contact forces are those at t_n, and not, as published, those that correct the prediction of t_n+1."""
        return self.integrator == EXACT_MODAL

    @property
    def length_of_rise_fraction(self) -> int:
        """Revolutions of which a casing's `rise_fraction` is a share: the run's, or the published ones until it settles."""
        return PUBLISHED_REVOLUTIONS if self.until_settled else self.revolutions

    @property
    def revolutions_in_statistic(self) -> int:
        """Revolutions at the end of a run which rms and the statistic of the stress are taken over.

        The last half of the run; of one that goes on until it settles as many as of the published run, if it has twice these.
        """
        length = min(self.revolutions, PUBLISHED_REVOLUTIONS) if self.until_settled else self.revolutions
        return length - length // 2

    @property
    def recorded(self) -> Self:
        """The choice with snapshots of all revolutions, if it has snapshots."""
        return replace(self, snapshot_revolutions=self.revolutions if self.snapshots_per_revolution else 0)
