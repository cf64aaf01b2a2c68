"""Rounds of a calibration: designs are simulated, surrogates fitted, and the next designs drawn from what is left possible."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from math import inf, nan

import numpy as np

from r37core.base.varied_number import VariedNumber
from r37core.config.spread import SpreadEntry
from r37core.sweep.driver import RunAll
from r37studies.agreement import WITHIN
from r37studies.member_values import drawn, sobol_points
from r37studies.surrogate.designs import Design
from r37studies.surrogate.gaussian_processes import fit, fit_chance
from r37studies.surrogate.proposal import propose

from .points import Measurement
from .sampling import Likelihood, draws

_ROUND_DRAWS, _LAST_DRAWS = 256, 1024
_APART = 0.03
"""Least distance of a new design from all others, as a share of the numbers' distributions."""

_LATER = 24
"""Designs, the last ones, by which the error of surrogates is judged."""

_SMALL = 0.02
"""Share of a measurement's largest value below which differences are absolute: the surrogates are of logarithms."""

Simulate = Callable[[Mapping[str, Mapping[VariedNumber, float]]], Sequence[Mapping[str, Sequence[float]] | str]]
"""Gives the values at the points of each measurement, of designs by name; or why one cannot be run."""


@dataclass
class Calibration:
    """Designs so far, at points of the unit cube, with their simulated values at all measured points.

    `measurements`: by name; `spreads`: distribution of each number; `nominal`: its value in the configuration. `simulated`:
    infinite where a run diverged or could not be done; `predicted`: values and deviations that surrogates gave the designs of
    all rounds but the first before they were run.
    """

    measurements: Mapping[str, Measurement]
    spreads: Mapping[VariedNumber, SpreadEntry]
    nominal: Sequence[float]
    seed: int
    run_all: RunAll
    cube: list[tuple[float, ...]] = field(default_factory=list)
    simulated: list[np.ndarray] = field(default_factory=list)
    predicted: list[np.ndarray] = field(default_factory=list)

    def run(self, budget: Sequence[int], simulate: Simulate, tell: Callable[[str], None]) -> None:
        """Simulate designs, of each round so many."""
        for number, count in enumerate(budget):
            tell(f"calibrate: round {number}, {count} designs" + (f"; {self.told}" if self.cube else ""))
            new = self._next(count)
            named = {
                f"c{len(self.cube) + place:04d}": drawn(self.spreads, self.nominal, point) for place, point in enumerate(new)
            }
            for point, gave in zip(new, simulate(named), strict=True):
                self.cube.append(point)
                # what cannot be run has no finite value
                values = self.floors + inf
                if not isinstance(gave, str):
                    values = np.concatenate([gave[name] for name in self.measurements])
                self.simulated.append(self.scaled(values))

    @cached_property
    def floors(self) -> np.ndarray:
        """Small value of each point that is added before the logarithm is taken."""
        values = [np.array(each.points.values) for each in self.measurements.values()]
        return np.maximum(np.concatenate([np.full(len(part), _SMALL * part.max()) for part in values]), 1e-300)

    def column(self, name: str) -> np.ndarray:
        """A field of the points of all measurements, one after the other."""
        return np.concatenate([getattr(each.points, name) for each in self.measurements.values()])

    def scaled(self, values: np.ndarray) -> np.ndarray:
        """Values at all points as the surrogates have them."""
        return np.log(np.maximum(values, 0.0) + self.floors)

    @property
    def measured(self) -> tuple[np.ndarray, np.ndarray]:
        """Measured values and their standard deviations, as the surrogates have them."""
        values = self.column("values")
        return self.scaled(values), self.column("deviations") / (values + self.floors)

    @property
    def misfits(self) -> np.ndarray:
        """Sum over the points, of each design, of squared differences over uncertainties, of far points their logarithm."""
        values, deviations = self.measured
        squares = ((np.array(self.simulated) - values) / deviations) ** 2
        return np.where(np.isfinite(squares), np.log1p(squares), nan).sum(axis=1)

    @property
    def told(self) -> str:
        """The best design so far, for messages."""
        if not np.isfinite(self.misfits).any():
            return "no design could be run to its end"
        values, deviations = self.measured
        near = np.abs((self.simulated[int(np.nanargmin(self.misfits))] - values) / deviations) <= WITHIN
        return f"best design: {near.sum()} of {len(near)} points within {WITHIN:g} sigma"

    def likelihood(self) -> Likelihood:
        """Likelihood of the measured points under the surrogates. Raises ValueError where too few runs end."""
        values, deviations = self.measured
        cube, simulated = np.array(self.cube), np.array(self.simulated)
        done = np.isfinite(simulated)
        if done.sum(axis=0).min() < 4:
            remedy = "narrower ranges of the numbers, or friction and damping at which runs do not diverge"
            raise ValueError(f"calibrate: fewer than 4 designs could be run to their end; {remedy}")
        columns, seed = zip(simulated.T, done.T, strict=True), self.seed
        calls = [partial(fit, cube[known], column[known], np.zeros(known.sum()), seed) for column, known in columns]
        fits = tuple(self.run_all(calls, "surrogates"))
        # the last designs lie where the measurements leave most possible
        means, sure = np.array(self.predicted[-_LATER:]).reshape(-1, 2, len(values)).swapaxes(0, 1)
        errors = np.where(done, simulated, nan)[len(simulated) - len(means) :] - means
        return Likelihood(fits, values, deviations, fit_chance(cube, done.all(axis=1), seed), (errors, sure))

    def posterior(self) -> tuple[Likelihood, np.ndarray, np.ndarray]:
        """The likelihood, draws over the unit cube and the logarithm of the likelihood there, the most likely first."""
        likelihood = self.likelihood()
        cube, logs = draws(likelihood.log, len(self.spreads), _LAST_DRAWS, self.seed)
        order = np.argsort(-logs, kind="stable")
        return likelihood, cube[order], logs[order]

    def _next(self, count: int) -> list[tuple[float, ...]]:
        """The first designs spread evenly; of others one is the search's proposal, the rest draws that are known least."""
        seed, numbers = self.seed, len(self.spreads)
        if not self.cube:
            return list(sobol_points(numbers, 1 << (count - 1).bit_length(), seed).values())[:count]
        known = enumerate(zip(self.cube, self.misfits.tolist(), strict=True))
        tried = [Design(f"{place}", point, (misfit,), (nan,), ()) for place, (point, misfit) in known]
        chosen, likelihood = [*propose([(0.0, 1.0)] * numbers, tried, 1, seed)], self.likelihood()
        cube, _ = draws(likelihood.log, numbers, _ROUND_DRAWS, seed + len(self.cube))
        _, deviations = likelihood.residuals(cube)
        unknown = np.log(deviations / likelihood.deviations[:, None]).sum(axis=0)
        for place in np.argsort(-unknown, kind="stable"):
            others = np.array([*self.cube, *chosen])
            if len(chosen) < count and np.abs(others - cube[place]).max(axis=1).min() > _APART:
                chosen.append(tuple(cube[place].tolist()))
        # where all draws are near to designs, any of them
        chosen += [tuple(point) for point in cube[: count - len(chosen)].tolist()]
        self.predicted += list(np.stack(likelihood.predicted(np.array(chosen))).transpose(2, 0, 1))
        return chosen
