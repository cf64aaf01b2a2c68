"""Contact length and moduli of a lining from a rub test, by least squares on the law in r37core.contact.laws.

The force is that of the products of both moduli and the yield stress with the contact length. So the logarithms of these three
products are fitted, and moduli apart from the length follow where the length is known.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
from scipy.optimize import least_squares
from scipy.stats import f, linregress, t

from r37core.contact.laws import worn
from r37core.contact.scene import Lining

_MODULI = ("elastic_modulus", "plastic_modulus", "yield_stress")


@dataclass(frozen=True)
class Estimate:
    """Best value and its ranges of 68 and 95%, which are (0, inf) where the forces say nothing."""

    best: float
    range_68: tuple[float, float]
    range_95: tuple[float, float]


@dataclass(frozen=True)
class LiningFit:
    """Lining that a rub test shows.

    `contact_length` (m), which goes with the scene's elastic modulus unless it was given; `values` by name: products with the
    contact length (N/m), or moduli (Pa) where that was given; `tangent_modulus` is that of loading beyond yield. `unknown`:
    what the forces cannot tell, or contradict in the law. `outliers`: points left out, counted from 1; `scatter` (N) about the
    law, rms. `scene`: keys for scenes.yaml, with moduli where the scene's do not fit in their ratios. `first_touch` (m) by
    test: depth at which forces begin, of tests in which that is not 0.
    """

    contact_length: Estimate
    values: dict[str, Estimate]
    unknown: tuple[str, ...]
    outliers: tuple[int, ...]
    scatter: float
    scene: dict[str, dict[str, float]]
    first_touch: dict[str, float]


def lining_force(products: Any, test: Any) -> np.ndarray:
    """Normal force (N) at the points of a `test`, shape (points,); `products` with the contact length (N/m) as in _MODULI."""
    lining = SimpleNamespace(**dict(zip(_MODULI, products, strict=True)), thickness=test.thickness)
    elastic_part = np.maximum(test.depth - worn(test.deepest, 0.0, lining), 0.0)
    return np.asarray(lining.elastic_modulus * test.width / test.thickness * elastic_part)


def first_touches(test: pd.DataFrame) -> dict[str, float]:
    """Depth (m) at which the forces of a test begin, by its name, of tests with air before it.

    The line through the forces of first contact cuts the axis there, by three standard deviations, or by a tenth of the depth
    after points without force; the law's own, through 0, curves the other way.
    """
    touches, least = {}, 0.02 * test.force.max()
    for name, points in test[test.depth >= test.deepest].groupby("place", sort=False):
        loaded = points[points.force > least]
        if len(loaded) > 2 and loaded.depth.nunique() > 1:
            line = linregress(loaded.depth, loaded.force)
            sure = max(3.0 * line.intercept_stderr, 0.01 * loaded.force.max())
            is_air = (points.depth < loaded.depth.min()) & (points.depth > 0.05 * points.depth.max())
            if line.slope > 0.0 and (-line.intercept > sure or is_air.any()):
                touches[str(name)] = float(np.clip(-line.intercept / line.slope, 0.0, loaded.depth.min()))
    return touches


class _Fit:
    """Least squares for the logarithms that are added to those of `base`, with the singular directions of the Jacobian.

    After them come changes of the depth of first touch, of tests that have one.
    """

    def __init__(self, test: pd.DataFrame, base: np.ndarray, count: int, loss: str = "linear"):
        known, arrays = "uncertainty" in test, SimpleNamespace(**{name: test[name].to_numpy() for name in test})
        self.scale = arrays.uncertainty if known else np.full(len(test), 0.02 * np.max(np.abs(arrays.force)))
        self.measured = arrays.force / self.scale

        names = [*dict.fromkeys(test.place[test.touch > 0.0])]
        self.before = (
            arrays.depth.max() * np.column_stack([test.place == name for name in names]) if names else np.empty((len(test), 0))
        )

        def residuals(numbers: np.ndarray) -> np.ndarray:
            air = self.before @ numbers[count:]
            moved = SimpleNamespace(**{**vars(arrays), "depth": arrays.depth - air, "deepest": arrays.deepest - air})
            return lining_force(np.exp(np.clip(base + numbers[:count], -250.0, 250.0)), moved) / self.scale - self.measured

        start = np.zeros(count + len(names))
        solution = least_squares(residuals, start, loss=loss, xtol=1e-10, ftol=1e-10, gtol=1e-10, max_nfev=60)
        self.logs, self.residuals = base + solution.x[:count], residuals(solution.x)
        self.touches = dict(zip(names, arrays.depth.max() * solution.x[count:], strict=True))
        self.freedom, self.squares = len(test) - len(start), float(self.residuals @ self.residuals)
        # no rig scatters less than 1e-4 of its largest force, or than its stated uncertainty
        self.variance = max(self.squares / max(self.freedom, 1), 1.0 if known else 0.005**2)
        self.left, sizes, self.axes = np.linalg.svd(solution.jac, full_matrices=False)
        # forces say nothing along smaller ones: finite differences in the Jacobian have an error of 1e-8
        self.blind, self.sizes = sizes < 1e-6 * sizes[0], np.maximum(sizes, 1e-6 * sizes[0])
        # HC3 of MacKinnon and White (1985) holds for a scatter that grows with the force, too
        scores = self.left * (self.residuals / np.maximum(1.0 - np.sum(self.left**2, axis=1), 0.1))[:, None]
        self.scores = scores.T @ scores
        self.quantiles = t.ppf([0.84, 0.975], max(self.freedom, 1))

    def estimate(self, best: float, axis: np.ndarray) -> Estimate:
        """The estimate of a value whose logarithm changes along `axis`, shape (parameters,)."""
        parts = self.axes @ np.pad(axis, (0, self.axes.shape[1] - len(axis))) / self.sizes
        deviation = np.sqrt(max(parts @ self.scores @ parts, self.variance * (parts @ parts)))
        if self.freedom < 1 or np.any(np.abs(parts * self.sizes)[self.blind] > 1e-3):
            deviation = np.inf
        with np.errstate(over="ignore"):
            factors = np.exp(self.quantiles * deviation)
        return Estimate(float(best), *((float(best / factor), float(best * factor)) for factor in factors))

    def is_as_good_as(self, other: "_Fit") -> bool:
        """True where scatter explains what `other`, with two parameters more, fits better: F test at 1%."""
        gain = (self.squares - other.squares) / (2.0 * other.variance)
        return other.freedom < 1 or bool(f.sf(gain, 2, other.freedom) > 0.01)


def fit_lining(test: pd.DataFrame, lining: Lining, contact_length: float | None = None) -> LiningFit:
    """Fit of the points of `read_rub_test`; `lining`: moduli that a contact length goes with where it (m) is not given."""
    touches = first_touches(test)
    air = test.place.map(touches).fillna(0.0)
    test = test.assign(touch=air, depth=test.depth - air, deepest=test.deepest - air)
    scene_logs = np.log(np.maximum([getattr(lining, name) for name in _MODULI], 1e-100))
    sample = test.iloc[:: 1 + len(test) // 2000]
    strains = np.quantile(np.maximum(sample.deepest / sample.thickness, 1e-9), (0.05, 0.2, 0.4, 0.6, 0.8, 1.0))
    shapes = [scene_logs, *((*scene_logs[:2], scene_logs[0] + np.log(strain)) for strain in strains)]
    starts = sorted((_scaled(shape, sample) for shape in shapes), key=lambda logs: _distance(logs, sample).mean())[:3]
    robust = min((_Fit(sample, logs, 3, "soft_l1").logs for logs in starts), key=lambda logs: _distance(logs, sample).mean())
    distance = _distance(robust, test)
    # a tenth of the points or more are no outliers, but another law
    far = distance > max(8.0 * 1.48 * float(np.median(distance)), 1e-3)
    points = test if len(far) < 6 or np.sum(far) > max(0.1 * len(far), 1.0) else test[~far]
    free, single = _Fit(points, robust, 3), _Fit(points, _scaled(scene_logs, points), 1)
    # a line through the origin may be elastic, or yield at once
    line = _scaled((*scene_logs[:2], scene_logs[0] - 28.0), points)
    if _Fit(points, line, 1).is_as_good_as(free):
        free = _Fit(points, line, 3)
    elastic, plastic, stress = np.exp(free.logs)
    tangent = np.array([plastic, elastic, 0.0]) / (elastic + plastic)
    as_scene = contact_length is None and single.is_as_good_as(free)
    known, unit, length = 1.0, "_times_length_n_m", free.estimate(elastic / lining.elastic_modulus, np.eye(3)[0])
    if contact_length is not None:
        known, unit, length = contact_length, "_pa", Estimate(contact_length, *2 * [(contact_length, contact_length)])
    elif as_scene:
        length = single.estimate(np.exp(single.logs - scene_logs)[0], np.ones(1))
    axes = dict(zip((*_MODULI, "tangent_modulus"), (*np.eye(3), tangent), strict=True))
    products = dict(zip(axes, (elastic, plastic, stress, elastic * tangent[0]), strict=True))
    moduli = {} if as_scene else {f"{name}_pa": float(products[name] / length.best) for name in _MODULI}
    return LiningFit(
        contact_length=length,
        values={name + unit: free.estimate(products[name] / known, axis) for name, axis in axes.items()},
        unknown=tuple(dict.fromkeys(_unknown(free, points))),
        outliers=tuple(int(row) + 1 for row in test.index.difference(points.index)),
        scatter=float(np.sqrt(np.mean((free.residuals * free.scale) ** 2))),
        scene={"lining": {"contact_length_m": length.best, **moduli}},
        first_touch={name: touch + float(free.touches[name]) for name, touch in touches.items() if name in free.touches},
    )


def _scaled(logs: Any, test: pd.DataFrame) -> np.ndarray:
    """Logarithms of products with the contact length that suits moduli of these `logs` best, shape (3,)."""
    force = lining_force(np.exp(logs), test)
    return np.asarray(logs) + np.log(max(force @ test.force / (force @ force), 1e-30))


def _distance(logs: np.ndarray, test: pd.DataFrame) -> np.ndarray:
    """Distances of the points from the law, shape (points,), in units of a scatter that may grow with the force."""
    force = lining_force(np.exp(logs), test)
    return np.asarray(np.abs(force - test.force) / (0.5 * np.max(np.abs(test.force)) + force))


def _unknown(fit: _Fit, test: pd.DataFrame) -> Iterator[str]:
    """Directions of the logarithms with a range of 95% to more than ten times the best value, and powers beyond the law."""
    deviations = np.sqrt(np.maximum(np.diag(fit.scores), fit.variance)) / fit.sizes
    wide = fit.blind | (fit.quantiles[1] * deviations > np.log(10.0))
    for axis in fit.axes[wide]:
        names = [name for name, part in zip(_MODULI, axis, strict=False) if abs(part) > 0.15]
        yield f"{' and '.join(names)}{' apart' if len(names) > 1 else ''}: unloading (column test) or other depths may tell"
    for name in {"speed", "thickness"} & {*test.columns[test.nunique() > 1]} if fit.freedom > 1 else ():
        trend = (fit.residuals + fit.measured) * np.log(test[name] / test[name].mean()).to_numpy()
        trend = trend - fit.left @ (fit.left.T @ trend)
        power = -(trend @ fit.residuals) / (trend @ trend)
        rest = fit.residuals + power * trend
        deviation = np.sqrt(max(rest @ rest / (fit.freedom - 1), 0.005**2) / (trend @ trend))
        if abs(power) > t.ppf(0.999, fit.freedom - 1) * deviation:
            yield f"{name}: forces have a further power {power:.2g} of it, which is not in the law; fit each {name} by itself"
