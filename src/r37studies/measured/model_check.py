"""Doubts about a fitted model, by direct runs with its numbers.

Two things speak against a model: too large differences, and differences of one sign over a segment of speeds or orders.
One point alone does not: the largest difference is left out of the first. Points are left out as on another branch where runs
at the same numbers reach them. Source of the second: random signs of the same differences (randomization: Fisher, The
Design of Experiments, 1935).
"""

from dataclasses import dataclass

import numpy as np
import scipy

from r37studies.agreement import WITHIN

from .calibration import Calibration
from .points import CONFIRMING
from .sampling import Likelihood

LIKELY_WRONG, BY_CHANCE = 0.9, 0.02
"""Chance that a right model fits better, from which on a misfit is told; and chance that signs are as they are, up to which."""

FAR, _CAPPED = 3.0, 4.0
"""Difference, over uncertainty, of a point that may lie on another branch; the largest that counts in a segment of one sign."""

_BRANCHES = 0.1
"""Largest share, of the points that a number depends on, that may lie on another branch."""

_TRIED, _LARGEST_STEP, _SHORTEST, _SIGNS = 8, 0.1, 4, 1000


@dataclass(frozen=True)
class ModelCheck:
    """Verdict on a model: `differences` over uncertainties and those on another branch, shape (points,).

    `misfit`: chance that a right model fits better; `by_chance`: that signs are as they are; `doubts`: what speaks against it.
    """

    differences: np.ndarray
    elsewhere: np.ndarray
    misfit: float
    by_chance: float
    doubts: tuple[str, ...]


def checked_model(calibration: Calibration, likelihood: Likelihood) -> ModelCheck:
    """Check of the model by the direct runs that fit best. Differences are less what a small change of the numbers mends."""
    _, deviations = calibration.measured
    together = np.array(calibration.simulated[-CONFIRMING:])
    # a jump of few of them is no scatter
    scatter = 1.48 * np.nanmedian(np.abs(together - np.nanmedian(together, axis=0)), axis=0)
    shares = deviations / np.hypot(deviations, np.where(np.isfinite(scatter), scatter, 0.0))
    order = np.argsort(calibration.misfits, kind="stable")[:_TRIED]
    fitted = [_mended(likelihood, np.array(calibration.cube[place]), calibration.differences[place], shares) for place in order]
    differences, slopes = min(fitted, key=lambda each: np.log1p(each[0] ** 2).sum())
    reached = (np.abs(calibration.differences[-CONFIRMING:]) <= WITHIN).any(axis=0)
    elsewhere = (np.abs(differences) > FAR) & reached
    # of all points, too
    depends = np.column_stack([np.abs(slopes) > _BRANCHES * np.abs(slopes).max(axis=0), np.ones(len(slopes), bool)])
    if (depends[elsewhere].sum(axis=0) > _BRANCHES * depends.sum(axis=0)).any():
        elsewhere[:] = False
    squares = np.sort(np.where(elsewhere, 0.0, differences) ** 2)[:-1]
    degrees = max(int((~elsewhere).sum()) - slopes.shape[1], 1)
    misfit, doubts = float(scipy.stats.chi2.cdf(squares.sum(), degrees)), []
    if misfit > LIKELY_WRONG:
        doubts.append(f"{min(misfit, 0.999):.1%} of right models would fit better")
    by_chance, segment = one_sided(differences, owners(calibration))
    if by_chance <= BY_CHANCE:
        low, high = np.sort(calibration.column("speeds")[segment])[[0, -1]]
        size = "larger" if differences[segment].sum() > 0.0 else "smaller"
        where = f"{low:.5g} to {high:.5g} rad/s"
        doubts.append(f"measured is {size} than simulated over {where} (by chance: {by_chance:.1%})")
    return ModelCheck(differences, elsewhere, misfit, by_chance, tuple(doubts))


def owners(calibration: Calibration) -> list[np.ndarray]:
    """Places of the points of each measurement, by engine order and speed, or angle."""
    places, first = [], 0
    for each in calibration.measurements.values():
        points = each.points
        keys = (points.angles or points.speeds, points.orders)
        places.append(first + np.lexsort(keys))
        first += len(points.values)
    return places


def _mended(
    likelihood: Likelihood, point: np.ndarray, differences: np.ndarray, shares: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Differences at a design, less what a step of the numbers takes, and slopes, (points, numbers), over uncertainties."""
    ends = np.clip(point + 0.02 * np.array([[-1.0], [1.0]])[:, :, None] * np.eye(len(point)), 0.0, 1.0)
    low, high = (likelihood.predicted(end)[0] for end in ends)
    slopes = (high - low) / np.diagonal(ends[1] - ends[0]) * (shares / likelihood.deviations)[:, None]
    away = np.nan_to_num(differences * shares, nan=99.0, posinf=99.0, neginf=-99.0)
    bounds = np.clip(-point, -_LARGEST_STEP, -1e-9), np.clip(1.0 - point, 1e-9, _LARGEST_STEP)
    solution = scipy.optimize.least_squares(
        lambda step: away - slopes @ step, np.zeros(len(point)), lambda step: -slopes, bounds, loss="soft_l1"
    )
    return away - slopes @ solution.x, slopes


def one_sided(differences: np.ndarray, places: list[np.ndarray]) -> tuple[float, np.ndarray]:
    """Chance that random signs give a segment as one-sided as the most one-sided, and places of its points.

    A segment, of four points or more, is measured by its sum over the square root of its length. `places`: of the points of
    each measurement in the order in which they are neighbours.
    """
    signs = np.random.default_rng(0).choice([-1.0, 1.0], (_SIGNS, len(differences)))
    signs[0] = 1.0
    drawn, most = signs * np.clip(differences, -_CAPPED, _CAPPED), np.zeros(_SIGNS)
    segment = np.arange(0)
    for own in places:
        sums = np.cumsum(np.pad(drawn[:, own], ((0, 0), (1, 0))), axis=1)
        for length in range(_SHORTEST, len(own) + 1):
            windows = np.abs(sums[:, length:] - sums[:, :-length]) / np.sqrt(length)
            first = int(windows[0].argmax())
            if windows[0, first] > most[0]:
                segment = own[first : first + length]
            most = np.maximum(most, windows.max(axis=1))
    return float(np.mean(most >= most[0] * (1.0 - 1e-9))), segment
