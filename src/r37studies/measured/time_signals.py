"""Engine orders of time signals and spectra: the rotor's angle, amplitudes, and how steady their phases are."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from .section import MeasurementError

LARGEST_ORDER = 24
"""Largest engine order that is fitted."""

MOST_SPEEDS = 60
"""Speeds of a measurement that are run; of more, those spread evenly over the curve and its largest value."""

_PART, _STEADY = 4.0, 0.005
"""Revolutions of a part whose orders are fitted together, and relative change of speed within which parts are averaged."""

_LEAST_SHARE = 0.1
"""Least share of the largest amplitude that counts."""

_LEAST_COHERENCE, _LONGEST = 0.5, 1e7

_GOES = 0.8
"""Least correlation of speeds with their rows in a sweep one way; it may stay at its ends."""


@dataclass(frozen=True, eq=False)
class OrderAmplitudes:
    """Amplitudes of engine `orders`, shape (speeds, orders), at `speeds` (rad/s), of so many `samples` each; a `remark`."""

    speeds: np.ndarray
    orders: np.ndarray
    amplitudes: np.ndarray
    samples: np.ndarray
    remark: str = ""


def turned(times: np.ndarray, speeds: np.ndarray) -> np.ndarray:
    """Revolutions since the first of the ascending `times` (s): the integral of the speed (rad/s), whose noise it averages."""
    steps = 0.5 * (speeds[1:] + speeds[:-1]) * np.diff(times)
    return np.concatenate([[0.0], np.cumsum(steps)]) / (2.0 * np.pi)


def passages(times: np.ndarray, pulses: np.ndarray) -> np.ndarray:
    """Times (s) at which a key phasor's pulses rise through their middle. Raises MeasurementError for uneven ones."""
    middle = 0.5 * (pulses.min() + pulses.max())
    rises = np.flatnonzero((pulses[:-1] < middle) & (pulses[1:] >= middle))
    shares = (middle - pulses[rises]) / (pulses[rises + 1] - pulses[rises])
    rising_times = times[rises] + shares * (times[rises + 1] - times[rises])
    periods = np.diff(rising_times)
    if len(periods) < 2 or periods.min() < 0.5 * np.median(periods) or periods.max() > 1.5 * np.median(periods):
        raise MeasurementError(
            "file",
            f"found {len(rising_times)} passages of a key phasor; allowed: three or more, evenly, one pulse a revolution",
        )
    return rising_times


def order_amplitudes(turns: np.ndarray, speeds: np.ndarray, values: np.ndarray, wanted: int | None = None) -> OrderAmplitudes:
    """Amplitudes of the engine orders that stand out, or of the `wanted` one; of each speed while that changes.

    `turns`: revolutions since the start; `speeds` (rad/s), shape (samples,). Parts of a few revolutions are fitted by least
    squares and their squares averaged: an angle that is a little wrong takes nothing from them. Raises MeasurementError for
    fewer than two revolutions, an order above half of the samples of one, and drifting phases: no order, or a wrong speed.
    """
    total = float(turns[-1] - turns[0])
    if not 2.0 <= total < _LONGEST:
        raise MeasurementError(
            "file", f"found a time signal of {total:.3g} revolutions; allowed: 2 or more, in the units of the header"
        )
    highest = min(LARGEST_ORDER, int(0.5 / np.median(np.diff(turns))))
    if not (wanted or 1) <= highest:
        raise MeasurementError(
            "file", f"found order {wanted or 1}; allowed: up to {highest}, half of the samples of a revolution"
        )
    count = max(int(total / _PART), 1)
    parts = np.minimum(((turns - turns[0]) / total * count).astype(int), count - 1)
    # gaps in a record leave parts without enough samples
    filled = np.flatnonzero(np.bincount(parts, minlength=count) > 2 * highest)
    kept = np.isin(parts, filled)
    if len(filled) < 1:
        raise MeasurementError("file", "found a time signal with more gaps than samples; allowed: a record without them")
    turns, speeds, values, count = turns[kept], speeds[kept], values[kept], len(filled)
    parts = np.searchsorted(filled, parts[kept])
    fits = [_fitted(turns[parts == part], values[parts == part], highest) for part in range(count)]
    waves, rest, noise = (np.array(each) for each in zip(*fits, strict=True))
    middles = np.array([np.mean(speeds[parts == part]) for part in range(count)])
    width = np.ptp(middles) or 1.0
    groups = np.clip(np.ceil(np.ptp(middles) / middles.mean() / _STEADY), 1, max(min(count // 2, MOST_SPEEDS), 1))
    _, places = np.unique(np.minimum((middles - middles.min()) / width * groups // 1, groups - 1), return_inverse=True)

    def group_means(part: np.ndarray) -> np.ndarray:
        return np.array([part[places == group].mean(axis=0) for group in range(places.max() + 1)])

    amplitudes = np.sqrt(np.maximum(group_means(np.abs(waves) ** 2 - noise[:, None]), 0.0))
    largest = amplitudes.max(axis=0)
    orders = np.array([wanted]) if wanted else 1 + np.flatnonzero(largest >= _LEAST_SHARE * largest.max())
    main = int(orders[largest[orders - 1].argmax()])
    strongest = waves[:, main - 1]
    alike = np.abs(group_means(strongest)) / np.sqrt(group_means(np.abs(strongest) ** 2) + 1e-300)
    coherence = float(np.median(alike))
    if coherence < _LEAST_COHERENCE and count > 1:
        turn = np.angle(np.sum(strongest[1:] * strongest[:-1].conj())) * count / (2.0 * np.pi * total * main)
        raise MeasurementError(
            "file",
            f"found phases of engine order {main} that drift (coherence {coherence:.2f}) as if the speed were {1.0 + turn:.5g} "
            "times as large; allowed: that speed, a column of speed or a key phasor, and a motion of engine orders",
        )
    explained = max(1.0 - float(rest.mean() / max(np.var(values), 1e-300)), 0.0)
    remark = f"engine orders explain {explained:.0%} of the signal, coherence {coherence:.2f}"
    samples = np.bincount(places[parts])
    return OrderAmplitudes(group_means(middles), orders, amplitudes[:, orders - 1], samples, remark)


def spectrum_amplitudes(
    frequencies: np.ndarray, values: np.ndarray, speed: float, wanted: int | None = None
) -> OrderAmplitudes:
    """Amplitudes of the engine orders in a spectrum over `frequencies` (rad/s) at a speed (rad/s): the highest line of each."""
    ratios = frequencies / speed
    nearest = np.rint(ratios).astype(int)
    own = (np.abs(ratios - nearest) <= 0.1) & (nearest >= 1) & (nearest <= (wanted or LARGEST_ORDER))
    lines = {order: float(values[own & (nearest == order)].max()) for order in np.unique(nearest[own]).tolist()}
    largest = max(lines.values(), default=0.0)
    kept = [order for order, value in lines.items() if (order == wanted if wanted else value >= _LEAST_SHARE * largest)]
    if not kept:
        raise MeasurementError(
            "file",
            f"found no line near {f'order {wanted}' if wanted else 'an engine order'} of {speed:.5g} rad/s; allowed: some",
        )
    remark = (
        "" if values.max() <= largest else f"the highest line, of order {ratios[values.argmax()]:.3g}, is of no engine order"
    )
    amplitudes = np.array([[lines[order] for order in kept]])
    return OrderAmplitudes(np.array([speed]), np.array(kept), amplitudes, np.array([len(values)]), remark)


def _fitted(turns: np.ndarray, values: np.ndarray, highest: int) -> tuple[np.ndarray, float, float]:
    """Complex amplitudes of all orders, the variance of the rest of the signal, and what noise adds to a squared amplitude."""
    waves = np.exp(2j * np.pi * np.arange(1, highest + 1) * turns[:, None])
    matrix = np.column_stack([np.ones(len(turns)), waves.real, waves.imag])
    numbers = np.linalg.lstsq(matrix, values, rcond=None)[0]
    rest = values - matrix @ numbers
    variance = float(rest @ rest / max(len(turns) - len(numbers), 1))
    return numbers[1 : highest + 1] - 1j * numbers[highest + 1 :], variance, 4.0 * variance / len(turns)


def sweep_legs(speeds: np.ndarray) -> list[tuple[str, slice]]:
    """Rows of each sweep `up` and `down` through most of the speeds (rad/s), in the order of the rows; none of a single one."""
    share = (speeds - speeds.min()) / (np.ptp(speeds) or 1.0)
    ends = np.flatnonzero((share < 0.25) | (share > 0.75))
    stays = np.split(ends, np.flatnonzero(np.diff(share[ends] > 0.5)) + 1)
    turns = [int(stay[np.abs(share[stay] - 0.5).argmax()]) for stay in stays[1:-1]]
    legs = [slice(first, last + 1) for first, last in pairwise([0, *turns, len(speeds) - 1])]
    if len(legs) < 2 or min(leg.stop - leg.start for leg in legs) < 3:
        return []
    correlations = [np.corrcoef(np.arange(leg.stop - leg.start), speeds[leg])[0, 1] for leg in legs]
    if np.abs(correlations).min() < _GOES:
        return []
    return [("up" if way > 0.0 else "down", leg) for way, leg in zip(correlations, legs, strict=True)]
