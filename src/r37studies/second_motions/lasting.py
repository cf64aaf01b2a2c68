"""Verdict on the motions of dwells: which last, which are left for good, and between which the blade switches."""

from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import Any

import numpy as np

WINDOW = 20
"""Revolutions over which the level of a motion is taken, to tell the motions apart."""

SETTLING = 50
"""Revolutions after a start that do not count."""

STARTS = HIGH, LOW, RANDOM = "high", "low", "random"
"""Where dwells start: in the largest and in the smallest motion of the sweeps, and in random states."""

VERDICT = ("high", "low", "share_of_time_high", "high_revolutions", "low_revolutions", "random_starts_high")
"""Columns of what becomes of the high and the low motion, the high one's share of the time, and how long each is held.

Share: of a long time, by the times for which both are held; NaN where neither is left, and of a lined blade. Revolutions: mean
time until it is left, infinite where it is never left, NaN where it is never there. `random_starts_high`: share of the random
starts that end in the high one.
"""


class Lasting(StrEnum):
    """Fate of a motion while the blade dwells: see `judged`."""

    LASTING = "lasting"
    SWITCHING = "switching"
    TRANSIENT = "transient"
    DIVERGED = "diverged"


def judged(rms: Mapping[str, Sequence[np.ndarray]], high: float, low: float, *, lined: bool) -> dict[str, Any]:
    """Verdict on motions by the `rms` (m) of each revolution of dwells that start HIGH, LOW and at RANDOM, as VERDICT.

    `high`, `low` (m): their levels. A motion that is left and come back to is switching. One that is left and never come back
    to is a transient, one that is never left lasts. Random starts count from the first time that they go over to the other
    motion. A lining does not grow back: a motion of a `lined` blade is lasting if it is held at the end of its dwell.
    """
    held = {start: [is_high(each, high, low) for each in several] for start, several in rms.items()}
    own = {HIGH: True, LOW: False}
    # a motion may be left before the first revolution that counts
    begun = {start: [np.append(first, part) for part in held[start]] for start, first in own.items()}
    left, times, ended = {}, {}, [bool(part[-1]) for part in held[RANDOM] if len(part)]
    for start in begun:
        if lined:
            # up to the first time that it is left
            parts = [np.logical_and.accumulate(part == own[start]) for part in begun[start]]
        else:
            parts = [part == own[start] for part in (*begun[HIGH], *begun[LOW], *map(_settled, held[RANDOM]))]
        left[start] = sum(np.count_nonzero(part[:-1] & ~part[1:]) for part in parts)
        revolutions = sum(map(np.count_nonzero, parts)) - len(begun[start])
        times[start] = revolutions / left[start] if left[start] else np.inf if revolutions else np.nan
    verdicts, lost = {}, {start: not rms[start] or any(np.isnan(each).any() for each in rms[start]) for start in begun}
    for start, other in ((HIGH, LOW), (LOW, HIGH)):
        lasts = all(part[-1] == own[start] for part in begun[start]) if lined else not left[start]
        if lined and lasts:
            times[start] = np.inf
        switching = left[other] and not lined
        verdicts[start] = Lasting.LASTING if lasts else Lasting.SWITCHING if switching else Lasting.TRANSIENT
        if lost[start]:
            verdicts[start] = Lasting.DIVERGED
    share = np.nan if lined or any(lost.values()) else _share(times[HIGH], times[LOW])
    values = (*verdicts.values(), share, *times.values(), float(np.mean(ended)) if ended else np.nan)
    return dict(zip(VERDICT, values, strict=True))


def _settled(held: np.ndarray) -> np.ndarray:
    """Motions that a random start holds from its first change on; all of them where it has none."""
    changes = np.flatnonzero(held[:-1] != held[1:])
    return held[changes[0] + 1 :] if len(changes) else held


def _share(high: float, low: float) -> float:
    if np.isinf(high) or np.isinf(low):
        return np.nan if high == low else float(np.isinf(high))
    return high / (high + low) if high + low > 0.0 else np.nan


def is_high(rms: np.ndarray, high: float, low: float) -> np.ndarray:
    """True where a motion is the high one, revolution by revolution after SETTLING, of dwells by their `rms` (m).

    By the rms of the last WINDOW revolutions: it becomes the high one above two thirds of the way from `low` to `high` (m), on
    a logarithmic scale, and the low one below a third of it.
    """
    rms = rms[np.isfinite(rms)]
    if len(rms) < SETTLING + WINDOW:
        return np.zeros(0, dtype=bool)
    level = np.sqrt(np.convolve(rms**2, np.full(WINDOW, 1.0 / WINDOW), "valid"))[SETTLING:]
    place = np.log(np.maximum(level, np.finfo(float).tiny) / low) / np.log(high / low)
    # between the two limits it is what it was before; at first what it is nearer to
    decided = np.where(place > 2.0 / 3.0, 1, np.where(place < 1.0 / 3.0, 0, -1))
    decided[0] = int(place[0] > 0.5)
    last = np.maximum.accumulate(np.where(decided >= 0, np.arange(len(decided)), 0))
    return decided[last] == 1
