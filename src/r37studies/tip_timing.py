"""Arrivals of a blade tip at probes in the casing."""

import numpy as np
from scipy.interpolate import CubicSpline


def arrival_times(
    times: np.ndarray, tangential: np.ndarray, point: np.ndarray, speed: float, probes: np.ndarray, turns: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Arrivals (s) at probes in the casing in each of the revolutions `turns`, and the displacements (m) that they tell.

    Both of shape (probes, turns). `times` (s) and `tangential` displacement (m, towards growing theta), shape (samples,), of
    a tip `point` (m), shape (3,); angles of the `probes` (rad), shape (probes,); `turns` count from 1; `speed` in rad/s. A tip
    that swings back over a probe counts when it first comes. NaN where the samples do not reach.

    The tip at angle theta + u/R in the frame of the rotor, which turns towards negative theta, is at theta + u/R - Omega t in
    the casing's. It passes a probe at angle p when that is p, up to whole turns:

        Omega t - u(t)/R = theta - p + 2 pi k        without vibration: Omega t0 = theta - p + 2 pi k

    so that t - t0 = u(t)/(Omega R), and R Omega (t - t0) is the tangential displacement at the arrival. Source: Heath and
    Imregun, A survey of blade tip-timing measurement techniques for turbomachinery vibration, J. Eng. Gas Turbines Power 120
    (1998) 784-791.
    """
    x, y, _ = point
    radius = np.hypot(x, y)
    rigid = (((np.arctan2(y, x) - probes) % (2.0 * np.pi))[:, None] + 2.0 * np.pi * (turns - 1)) / speed
    arrivals = np.full(rigid.shape, np.nan)
    known = np.isfinite(tangential)
    if np.count_nonzero(known) < 4:
        return arrivals, arrivals
    times, tangential = times[known], tangential[known]
    displacement = CubicSpline(times, tangential)
    # how far the tip has turned; what it reached once, however it swings
    turned = speed * times - tangential / radius
    reached = np.maximum.accumulate(turned)
    wanted = speed * rigid
    inside = (wanted > turned[0]) & (wanted <= reached[-1])
    after = np.searchsorted(reached, wanted[inside])
    early, late = times[after - 1], times[after]
    # halved to the last bit
    for _ in range(60):
        middle = 0.5 * (early + late)
        there = speed * middle - displacement(middle) / radius >= wanted[inside]
        early, late = np.where(there, early, middle), np.where(there, middle, late)
    arrivals[inside] = late
    return arrivals, radius * speed * (arrivals - rigid)
