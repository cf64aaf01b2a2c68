"""Gaussian processes of scikit-learn, the extra package `search`, on points of the unit cube: of numbers and of a yes or no.

Every fit runs on one thread of linear algebra, for the same bits on any number of cores.
"""

import math
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from types import ModuleType
from typing import Any, Self

import numpy as np

from r37core.base.process_wide import ProcessWide, one_thread

RESTARTS = 1
"""Fits from other hyperparameters than the usual, the likeliest of all is taken."""

_LENGTHS = 0.05, 20.0
_NOISES = 1e-6, 0.3


class SearchPackageMissing(ImportError):
    """The extra package of a search is not installed; the message says how to install it."""


def library() -> ModuleType:
    """`sklearn.gaussian_process`; raises SearchPackageMissing."""
    try:
        import sklearn.gaussian_process
    except ImportError:
        raise SearchPackageMissing(
            "a search needs the extra package scikit-learn: pip install -e '.[search]' in the folder of the copy of r37"
        ) from None
    return sklearn.gaussian_process


@dataclass(frozen=True)
class Fit:
    """A Gaussian process of one number, or that number where it is the same everywhere (`process` is None)."""

    process: Any
    mean: float
    scale: float

    @property
    def noise(self) -> float:
        """Variance of the noise, in squares of the scale."""
        return 0.0 if self.process is None else float(self.process.kernel_.k2.noise_level)

    def at(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Mean and standard deviation [point] of the number itself, without its noise."""
        if self.process is None:
            return np.full(len(points), self.mean), np.zeros(len(points))
        with _quiet():
            mean, deviation = self.process.predict(points, return_std=True)
        # the process counts the noise of a new value, too
        latent = np.sqrt(np.maximum(deviation**2 - self.noise, 1e-12))
        return self.mean + self.scale * mean, self.scale * latent

    def believing(self, point: np.ndarray) -> Self:
        """Process as if `point` had turned out as expected: what a batch knows of its earlier designs."""
        known = self.process
        if known is None:
            return self
        expected = (self.at(point[None])[0] - self.mean) / self.scale
        # with the same hyperparameters
        process = library().GaussianProcessRegressor(known.kernel_, alpha=np.append(known.alpha, 1e-8), optimizer=None)
        with _quiet():
            process.fit(np.vstack([known.X_train_, point]), np.append(known.y_train_, expected))
        return replace(self, process=process)


def fit(points: np.ndarray, numbers: np.ndarray, scatters: np.ndarray, seed: int) -> Fit:
    """The process through `numbers` at `points` [point, variable].

    `scatters` are standard deviations of the numbers; to them, and where they are 0 or NaN, the likelihood adds a noise of its
    own, equal at all points. Matern kernel of order 5/2 with a length for each variable.
    Source: Rasmussen and Williams (2006), Gaussian Processes for Machine Learning, chapters 2 and 5.
    """
    mean, scale = float(numbers.mean()), float(numbers.std())
    if scale <= 1e-12 * max(1.0, abs(mean)):
        return Fit(None, mean, 0.0)
    gp = library()
    variances = 1e-8 + (np.nan_to_num(scatters, nan=0.0) / scale) ** 2
    kernel = gp.kernels.ConstantKernel(1.0, (0.05, 50.0)) * _matern(points.shape[1]) + gp.kernels.WhiteKernel(1e-3, _NOISES)
    process = gp.GaussianProcessRegressor(kernel, alpha=variances, n_restarts_optimizer=RESTARTS, random_state=seed)
    with _quiet():
        process.fit(points, (numbers - mean) / scale)
    return Fit(process, mean, scale)


def fit_chance(points: np.ndarray, holds: np.ndarray, seed: int) -> Callable[[np.ndarray], np.ndarray]:
    """Probability [point] that something holds at points, from where it did [point] and did not; 1 where it always did."""
    if holds.all() or not holds.any():
        return lambda others: np.full(len(others), 1.0 if holds.all() else 0.5)
    gp = library()
    kernel = gp.kernels.ConstantKernel(4.0, (0.5, 100.0)) * _matern(points.shape[1])
    classifier = gp.GaussianProcessClassifier(kernel, random_state=seed)
    with _quiet():
        classifier.fit(points, holds)

    def chance_at(others: np.ndarray) -> np.ndarray:
        with _quiet():
            return classifier.predict_proba(others)[:, 1]

    return chance_at


def _matern(variables: int) -> Any:
    return library().kernels.Matern([0.5 * math.sqrt(variables)] * variables, _LENGTHS, nu=2.5)


@contextmanager
def _without_warnings() -> Iterator[None]:
    with one_thread(), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


_quiet = ProcessWide(_without_warnings)
"""One thread of linear algebra, and no warning of a hyperparameter at its bound: few designs do not tell all of them."""
