"""Requirements: what a blade has to keep in operation."""

from dataclasses import dataclass, field, replace
from typing import Annotated, Self

import numpy as np

from r37core.base.declared import Key
from r37core.results.operating_range import OperatingRange

WIDTH = 5.0
"""Width of a narrow interaction (rad/s): between speeds that lie farther apart one may be hidden."""

STEP = 0.5 * WIDTH
"""Step (rad/s) between the further runs from rest."""

NEAR = 1.0 / 3.0
"""Share of a limit from which further runs may come to it."""

LEAST_STEP = 0.2
"""Distance (rad/s) of runs about a peak between which nothing is run."""

CARRIED_STEP = WIDTH
"""Step (rad/s) between the speeds that a motion is carried through."""

MOST_NEAR, OTHERS = 24, 11
"""Speeds, those nearest to the limit, that are run in so many other ways: other friction, step, mesh, damping and rise."""

BRIEF = 4
"""Revolutions over which lobes rise in a further try: some blades have more stress then than with faster and slower rise."""

LONGEST = 1000
"""Most revolutions of a run that ends as it has settled."""

FOLLOWED = 3200
"""Most revolutions of a run whose motion still grows after LONGEST."""

RUN_UPS = (100, 500, 2500)
"""Revolutions of the run-ups over the judged range where the operating range has no rate of its own."""

RESULTS = ("spectrum", "stress", "static_stress", "fatigue", "wear")
"""Results of a scene that further runs have: those that requirements and interactions need."""


@dataclass(frozen=True)
class CampbellMargin:
    """Least distance of crossings of a `mode` with engine orders from speeds in operation: dwells, else all of the range."""

    mode: Annotated[str, Key("Mode of the Campbell diagram: 1B, 1T, 2B, 4, ..., or combination of two: 7-5, 5+7")]
    engine_orders: Annotated[tuple[int, ...], Key("Engine orders of the crossings", ge=1, le=1000)]
    least: Annotated[
        float,
        Key(
            "Least distance of a crossing from a dwell, without dwells from the range", "_percent", "at_least", ge=1e-6, le=100
        ),
    ]


@dataclass(frozen=True)
class Requirements:
    """Requirements on each blade in each scene inside the operating range; None where nothing is."""

    above_yield: Annotated[
        float | None,
        Key(
            "Largest length of the dangerous speeds: above yield inside the model",
            "_rad_s",
            "above_yield_at_most",
            ge=0,
            le=1e6,
        ),
    ] = None
    goodman_share: Annotated[
        float | None, Key("Largest share of the Goodman line", name="goodman_share_at_most", ge=1e-6, le=1e6)
    ] = None
    miner_sum: Annotated[
        float | None, Key("Largest share of the life that a run-up uses, by Miner", name="miner_sum_at_most", ge=1e-12, le=1e6)
    ] = None
    used_lining: Annotated[
        float | None,
        Key("Largest share of the lining's thickness that is used", "_percent", "used_lining_at_most", ge=1e-6, le=100),
    ] = None
    clearance: Annotated[
        float | None,
        Key(
            "Smallest clearance to the round casing, where blade and casing grow as grown",
            "_m",
            "clearance_at_least",
            ge=0,
            le=1,
        ),
    ] = None
    mass: Annotated[float | None, Key("Largest mass of the blade", "_kg", "mass_at_most", ge=1e-9, le=1e6)] = None
    campbell_margins: tuple[CampbellMargin, ...] = field(default=())

    @property
    def run_requirements(self) -> Self:
        """Requirements on what runs give alone."""
        return replace(self, miner_sum=None, clearance=None, mass=None, campbell_margins=())

    @property
    def any(self) -> bool:
        """True if there is one."""
        return self != Requirements()


def run_up_lengths(operating: OperatingRange) -> dict[float, float]:
    """Rate (rad/s2) of each run-up over the judged range, and of its run-down -> its revolutions."""
    squares = (operating.last**2 - operating.first**2) / (4.0 * np.pi)
    lengths = [squares / operating.rate] if operating.rate else RUN_UPS
    return {squares / length: length for length in lengths}


def most_further_runs(operating: OperatingRange) -> int:
    """Further runs of a blade and scene at constant speed in an operating range, without those about peaks."""
    width = operating.last - operating.first
    return round(width / STEP + 2.0 * width / CARRIED_STEP) + OTHERS * MOST_NEAR
