"""Rounds of a calibration: designs are simulated, surrogates fitted, and the next designs drawn from what is left possible.

The last designs lie together at the most likely values: they show without a surrogate whether the model is right.
"""

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
from r37studies.surrogate.gaussian_processes import fit, fit_chance

from .points import GAIN, Measurement
from .sampling import Likelihood, draws

_ROUND_DRAWS, _LAST_DRAWS = 256, 1024
_APART = 0.03
"""Least distance of a new design from all others, as a share of the numbers' distributions."""

_TOGETHER = 0.003
"""How far the last designs lie from the most likely values, as a share of the numbers' distributions."""

_INSIDE = 1e-9, 1.0 - 1e-9
"""Shares between which a normal distribution has values."""

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
    infinite where a run diverged or could not be done; `predicted`: values and deviations that surrogates gave a design before
    it was run, NaN of the first and the last designs. Gains, which need no runs, are the last numbers: `gains` by measurement.
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
            new = self._together(count) if number and number == len(budget) - 1 else self._next(count)
            named = {
                f"c{len(self.cube) + place:04d}": drawn(self.spreads, self.nominal, point) for place, point in enumerate(new)
            }
            self.predicted += (len(self.cube) + count - len(self.predicted)) * [np.full((2, len(self.floors)), nan)]
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
        # where all is 0, what the instrument would have seen
        floors = [_SMALL * max(each.points.values) or max(each.points.deviations) for each in self.measurements.values()]
        return np.repeat(floors, [len(each.points.values) for each in self.measurements.values()])

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
    def differences(self) -> np.ndarray:
        """Measured less simulated values of each design, over the uncertainties of measurement, shape (designs, points)."""
        values, deviations = self.measured
        return (values - np.array(self.simulated) - self.gain_logs(np.array(self.cube))) / deviations

    @property
    def misfits(self) -> np.ndarray:
        """Sum over the points, of each design, of squared differences over uncertainties, of far points their logarithm."""
        squares = self.differences**2
        return np.where(np.isfinite(squares), np.log1p(squares), nan).sum(axis=1)

    def gain_logs(self, cube: np.ndarray) -> np.ndarray:
        """Logarithm of the gain of each point, shape (draws, points)."""
        logs = np.zeros((len(cube), len(self.floors)))
        owners = np.array([name for name, each in self.measurements.items() for _ in each.points.values])
        for column, (number, spread) in enumerate(self.spreads.items()):
            if number.kind == GAIN:
                values = [spread.value(1.0, share) for share in np.clip(cube[:, column], *_INSIDE)]
                logs[:, owners == number.key.removesuffix(f".{GAIN}")] += np.log(np.maximum(values, 1e-3))[:, None]
        return logs

    @property
    def told(self) -> str:
        """The best design so far, for messages."""
        if not np.isfinite(self.misfits).any():
            return "no design could be run to its end"
        near = np.abs(self.differences[int(np.nanargmin(self.misfits))]) <= WITHIN
        return f"best design: {near.sum()} of {len(near)} points within {WITHIN:g} sigma"

    def likelihood(self) -> Likelihood:
        """Likelihood of the measured points under the surrogates. Raises ValueError where too few runs end."""
        values, deviations = self.measured
        cube, simulated = np.array(self.cube), np.array(self.simulated)
        done = np.isfinite(simulated)
        if done.sum(axis=0).min() < 4:
            remedy = "narrower ranges of the numbers, or friction and damping at which runs do not diverge"
            raise ValueError(f"calibrate: fewer than 4 designs could be run to their end; {remedy}")
        cube = cube[:, : self.varied]
        columns, seed = zip(simulated.T, done.T, strict=True), self.seed
        calls = [partial(fit, cube[known], column[known], np.zeros(known.sum()), seed) for column, known in columns]
        fits = tuple(self.run_all(calls, "surrogates"))
        # the last ones that were predicted lie where the measurements leave most possible
        means, sure = np.array(self.predicted).swapaxes(0, 1)
        judged = np.flatnonzero(np.isfinite(means[:, 0]))[-_LATER:]
        errors = np.where(done, simulated, nan)[judged] - means[judged]
        buildable = fit_chance(cube, done.all(axis=1), seed)
        return Likelihood(fits, values, deviations, buildable, (errors, sure[judged]), self.varied, self.gain_logs)

    @property
    def varied(self) -> int:
        """How many numbers the runs depend on; gains come after them."""
        return sum(number.kind != GAIN for number in self.spreads)

    def posterior(self) -> tuple[Likelihood, np.ndarray, np.ndarray]:
        """The likelihood, draws over the unit cube and the logarithm of the likelihood there, the most likely first."""
        likelihood = self.likelihood()
        cube, logs = draws(likelihood.log, len(self.spreads), _LAST_DRAWS, self.seed)
        order = np.argsort(-logs, kind="stable")
        return likelihood, cube[order], logs[order]

    def _together(self, count: int) -> list[tuple[float, ...]]:
        """The most likely numbers and others so near that only chance, or another branch, makes their runs differ."""
        _, cube, _ = self.posterior()
        offsets = np.random.default_rng(self.seed).uniform(-_TOGETHER, _TOGETHER, (count, cube.shape[1]))
        offsets[0] = 0.0
        return list(map(tuple, np.clip(cube[0] + offsets, *_INSIDE).tolist()))

    def _next(self, count: int) -> list[tuple[float, ...]]:
        """The first designs spread evenly; of others one is the most likely, the rest draws that are known least."""
        seed, numbers = self.seed, len(self.spreads)
        if not self.cube:
            return list(sobol_points(numbers, 1 << (count - 1).bit_length(), seed).values())[:count]
        likelihood, chosen = self.likelihood(), list[tuple[float, ...]]()
        cube, logs = draws(likelihood.log, numbers, _ROUND_DRAWS, seed + len(self.cube))
        _, deviations = likelihood.residuals(cube)
        unknown = np.log(deviations / likelihood.deviations[:, None]).sum(axis=0)
        for place in [logs.argmax(), *np.argsort(-unknown, kind="stable")]:
            others = np.array([*self.cube, *chosen])
            if len(chosen) < count and np.abs(others - cube[place]).max(axis=1).min() > _APART:
                chosen.append(tuple(cube[place].tolist()))
        # where all draws are near to designs, any of them
        chosen += [tuple(point) for point in cube[: count - len(chosen)].tolist()]
        self.predicted += list(np.stack(likelihood.predicted(np.array(chosen))).transpose(2, 0, 1))
        return chosen
