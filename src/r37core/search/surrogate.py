"""Predictions between the tried designs: slices of each objective with a band, and which variables decide it."""

from collections.abc import Sequence

import numpy as np
import scipy

from .gaussian_processes import Fit, fit
from .problem import FEWEST_DONE, Design, SearchVariable, shares

_SAMPLE = 1024


def slices(
    variables: Sequence[SearchVariable], evaluated: Sequence[Design], at: Sequence[float], points: int, seed: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Surrogate of each objective at `points` values of each variable, the others as in the design `at`.

    These values [variable, point], its mean and its standard deviation [objective, variable, point], in units of the
    objectives; NaN where too few designs could be built.
    """
    along = np.linspace(0.0, 1.0, points)
    places = np.tile(shares(variables, [at])[0], (len(variables), points, 1))
    for number in range(len(variables)):
        places[number, :, number] = along
    bands = np.full((2, len(evaluated[0].objectives), len(variables), points), np.nan)
    for number, process in enumerate(objective_fits(variables, evaluated, seed)):
        bands[:, number] = np.reshape(process.at(places.reshape(-1, len(variables))), (2, len(variables), points))
    values = [variable.lowest + along * (variable.highest - variable.lowest) for variable in variables]
    return np.array(values), *bands


def sensitivity(
    variables: Sequence[SearchVariable], evaluated: Sequence[Design], seed: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """First-order and total Sobol' indices [objective, variable] of the surrogates, the variables uniform over their ranges.

    The third [objective] is the share of the variance that a surrogate predicts at designs it was not told of, 1 at best, 0
    or less where the indices mean nothing: designs are left out one at a time with the hyperparameters of all. NaN where all
    designs have the same objective, or too few could be built.
    Source: Saltelli et al. (2010), Comput. Phys. Commun. 181, 259-270, in scipy.stats.sobol_indices; Q2 as in Marrel et al.
    (2009), Reliab. Eng. Syst. Saf. 94, 742-751.
    """
    objectives = len(evaluated[0].objectives)
    first, total = np.full((2, objectives, len(variables)), np.nan)
    predicted = np.full(objectives, np.nan)
    for number, process in enumerate(objective_fits(variables, evaluated, seed)):
        if process.is_constant:
            continue
        first[number], total[number] = _indices(process, len(variables), seed)
        misses = process.numbers - [process.without(index) for index in range(len(process.numbers))]
        predicted[number] = 1.0 - np.mean(misses**2) / np.var(process.numbers)
    return first, total, predicted


def objective_fits(variables: Sequence[SearchVariable], evaluated: Sequence[Design], seed: int) -> list[Fit]:
    """The process of each objective over shares of the ranges; none where fewer than `FEWEST_DONE` designs could be built."""
    known = sorted((design for design in evaluated if design.is_done), key=lambda design: (design.values, design.name))
    if len(known) < FEWEST_DONE:
        return []
    points = shares(variables, [design.values for design in known])
    objectives = np.array([design.objectives for design in known]).T
    scatters = np.array([design.scatters for design in known]).T
    return [fit(points, *each, seed) for each in zip(objectives, scatters, strict=True)]


def _indices(process: Fit, variables: int, seed: int) -> np.ndarray:
    """First-order and total index of each variable [2, variable]."""
    if variables == 1:
        # all of the variance is of the one variable, for which scipy has no indices
        return np.ones((2, 1))
    dists = [scipy.stats.uniform()] * variables
    sobol = scipy.stats.sobol_indices(func=lambda points: process.at(points.T)[0], n=_SAMPLE, dists=dists, rng=seed)
    return np.array([sobol.first_order, sobol.total_order])
