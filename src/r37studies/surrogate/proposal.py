"""Which designs to try next: the first ones fill the ranges, later ones are proposed from all results so far.

A proposal is the most promising of many candidate points: expected improvement of the objective, times the probability that
every constraint is kept, times the probability that the design can be built. Gaussian processes say all three.
Sources: Jones, Schonlau and Welch (1998), J. Global Optim. 13, 455-492 (expected improvement); Gardner et al. (2014), ICML
(constraints); Ginsbourger, Le Riche and Carraro (2010), Comput. Intell. in Expensive Optim. Problems, 131-162 (a batch believes
the mean at its earlier designs); Knowles (2006), IEEE Trans. Evol. Comput. 10, 50-66 (several objectives under random weights).
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
import scipy

from .designs import FEWEST_DONE, Design, Ranges, designs_at, shares
from .gaussian_processes import Fit, fit, fit_chance

NEAR = 0.01
"""Two designs differ by at least this share of the range of some variable, as long as there is room for it."""

_CANDIDATES = 1024
_DRAWS = 64


def first_designs(ranges: Ranges, number: int, seed: int) -> list[tuple[float, ...]]:
    """The first `number` designs of a scrambled Sobol sequence: more of them change none. This is plain sampling, too."""
    return designs_at(ranges, _sobol(len(ranges), number, seed))


def propose(ranges: Ranges, evaluated: Sequence[Design], batch: int, seed: int) -> list[tuple[float, ...]]:
    """The next `batch` designs, values in the order of the `ranges`.

    They depend neither on the order of `evaluated` nor on the number of cores. Raises SearchPackageMissing without the library.
    """
    known = sorted(evaluated, key=lambda design: (design.values, design.name))
    generator = np.random.default_rng([seed, len(known)])
    tried = shares(ranges, [design.values for design in known])
    models = _fitted(tried, known, int(generator.integers(2**31)))
    chosen: list[np.ndarray] = []
    for _ in range(batch):
        point = _next_point(models, np.vstack([tried, *chosen]), generator)
        chosen.append(shares(ranges, designs_at(ranges, point[None]))[0])
        models = models.believing(chosen[-1])
    return designs_at(ranges, np.reshape(chosen, (-1, len(ranges))))


@dataclass(frozen=True)
class Models:
    """Fits of all results so far: of each objective (compressed) and margin, and of the chance to build a design."""

    objectives: tuple[Fit, ...]
    margins: tuple[Fit, ...]
    buildable: Callable[[np.ndarray], np.ndarray]
    feasible: np.ndarray

    def believing(self, point: np.ndarray) -> Self:
        """Models after a design of the batch, which turns out as expected."""
        return replace(
            self,
            objectives=tuple(each.believing(point) for each in self.objectives),
            margins=tuple(each.believing(point) for each in self.margins),
            feasible=np.vstack([self.feasible, point]) if len(self.feasible) else self.feasible,
        )

    def log_chance(self, points: np.ndarray) -> np.ndarray:
        """Logarithm of the probability [point] that a design can be built and keeps every constraint."""
        total = np.log(np.maximum(self.buildable(points), 1e-300))
        for margin in self.margins:
            mean, deviation = margin.at(points)
            total += scipy.stats.norm.logcdf(mean / np.maximum(deviation, 1e-9 * max(margin.scale, abs(margin.mean), 1e-300)))
        return total

    def log_improvement(self, points: np.ndarray, generator: np.random.Generator) -> np.ndarray | None:
        """Logarithm of the improvement [point] that is expected on the best feasible design; None where nothing can say it.

        The best is by the mean of the surrogate, not by what was measured, which may have been luck. Several objectives are
        one under random weights: the largest weighted distance from the best of each, and a little of their sum.
        """
        if not len(self.feasible) or all(each.process is None for each in self.objectives):
            return None
        here = np.vstack([points, self.feasible])
        means, deviations = (np.array(part) for part in zip(*(each.at(here) for each in self.objectives), strict=True))
        best = means[:, len(points) :]
        lowest, width = best.min(1, keepdims=True), np.ptp(best, axis=1, keepdims=True)
        width = np.where(width > 0, width, 1.0)
        means, deviations = (means - lowest) / width, deviations / width
        new, best_means = np.split(means, [len(points)], axis=1)
        if len(means) == 1:
            return _log_expected(new[0], deviations[0, : len(points)], float(best_means.min()))
        weights = generator.dirichlet(np.ones(len(means)))[:, None]
        best = _scalar(best_means, weights).min()
        draws = generator.standard_normal((_DRAWS, len(means), 1))
        values = _scalar(new + deviations[:, : len(points)] * draws, weights)
        return np.log(np.maximum(best - values, 0.0).mean(0) + 1e-12)


def _fitted(tried: np.ndarray, known: Sequence[Design], seed: int) -> Models:
    is_done, is_feasible = (np.array([getattr(each, name) for each in known], bool) for name in ("is_done", "is_feasible"))
    done = [design for design in known if design.is_done]
    points, feasible = tried[is_done], tried[is_feasible]
    buildable = fit_chance(tried, is_done, seed)
    if len(done) < FEWEST_DONE:
        return Models((), (), buildable, feasible[:0])
    kinds = ("objectives", "scatters", "margins")
    objectives, scatters, margins = (np.array([getattr(design, kind) for design in done]).T for kind in kinds)
    return Models(
        tuple(fit(points, *_compressed(*each), seed) for each in zip(objectives, scatters, strict=True)),
        tuple(fit(points, margin, np.zeros(len(done)), seed) for margin in margins),
        buildable,
        feasible,
    )


def _compressed(numbers: np.ndarray, scatters: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Numbers and their scatter with those above the median drawn together: how bad the bad designs are matters little."""
    middle = np.median(numbers)
    above = np.maximum(numbers - middle, 0.0)
    width = float(middle - numbers.min()) or float(above.max()) or 1.0
    return np.where(above > 0, middle + width * np.log1p(above / width), numbers), scatters / (1.0 + above / width)


def _next_point(models: Models, taken: np.ndarray, generator: np.random.Generator) -> np.ndarray:
    """The most promising of points all over the ranges, of points around the best designs, and at last around the winners."""
    candidates = _sobol(taken.shape[1], _CANDIDATES, int(generator.integers(2**31)))
    candidates = np.vstack([candidates, *(_around(models.feasible, spread, generator) for spread in (0.1, 0.03))])
    draws = generator.bit_generator.random_raw()
    worth = _worth(models, candidates, taken, draws)
    for spread in (0.05, 0.01):
        leaders = candidates[np.argsort(-worth, kind="stable")[:8]]
        closer = _around(leaders, spread, generator)
        candidates, worth = np.vstack([candidates, closer]), np.append(worth, _worth(models, closer, taken, draws))
    # no near copy of a design; where all are, the one farthest from them
    distance = scipy.spatial.distance.cdist(candidates, taken, "chebyshev").min(1, initial=np.inf)
    allowed = distance >= min(NEAR, distance.max())
    return candidates[int(np.argmax(np.where(allowed, worth, -np.inf)))]


def _worth(models: Models, points: np.ndarray, taken: np.ndarray, draws: int) -> np.ndarray:
    """Logarithm [point] of what a design there promises; where no improvement can be said, distance from all others is."""
    promise = models.log_improvement(points, np.random.default_rng(draws))
    if promise is None:
        distance = scipy.spatial.distance.cdist(points, taken).min(1) if len(taken) else np.ones(len(points))
        promise = np.log(np.maximum(distance, 1e-12))
    return models.log_chance(points) + promise


def _around(centres: np.ndarray, spread: float, generator: np.random.Generator) -> np.ndarray:
    """Points about `centres` [point, variable], within the ranges."""
    if not len(centres):
        return centres
    moved = np.repeat(centres, math.ceil(256 / len(centres)), axis=0)
    return np.clip(moved + spread * generator.standard_normal(moved.shape), 0.0, 1.0)


def _scalar(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Augmented weighted Chebyshev distance [.., point] of objectives [.., objective, point]."""
    weighted = weights * values
    return weighted.max(-2) + 0.05 * weighted.sum(-2)


def _log_expected(mean: np.ndarray, deviation: np.ndarray, best: float) -> np.ndarray:
    """Logarithm of the expected improvement of a normal distribution below `best`, finite far in the tail, too."""
    deviation = np.maximum(deviation, 1e-12)
    ahead = (best - mean) / deviation
    density, tail = scipy.stats.norm.logpdf(ahead), scipy.stats.norm.logcdf(ahead)
    # pdf + ahead cdf = pdf (1 + ahead cdf / pdf), where the ratio goes to -1 + 1 / ahead^2
    share = np.where(ahead > -30, 1.0 + ahead * np.exp(np.minimum(tail - density, 700.0)), 1.0 / np.maximum(ahead**2, 1.0))
    near = np.log(np.maximum(share, 1e-12)) + density
    return np.log(deviation) + np.where(ahead > 5, np.log(np.maximum(ahead, 1.0)), near)


def _sobol(variables: int, number: int, seed: int) -> np.ndarray:
    """The first `number` points of a scrambled Sobol sequence, [point, variable]."""
    return scipy.stats.qmc.Sobol(variables, rng=seed).random_base2((max(number, 1) - 1).bit_length())[:number]
