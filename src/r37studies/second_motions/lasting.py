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
    # a motion may be left before the first revolution that counts
    begun = {HIGH: [np.append(True, part) for part in held[HIGH]], LOW: [np.append(True, ~part) for part in held[LOW]]}
    ended = [bool(part[-1]) for part in held[RANDOM] if len(part)]
    lost = {start: not rms[start] or any(np.isnan(each).any() for each in rms[start]) for start in (HIGH, LOW)}
    if lined:
        since = {start: [np.logical_and.accumulate(part) for part in several] for start, several in begun.items()}
        left = {start: sum(int(not part[-1]) for part in several) for start, several in since.items()}
        back = {start: sum(int(part[-1]) for part in several) == len(several) for start, several in begun.items()}
        verdicts = {start: Lasting.LASTING if back[start] else Lasting.TRANSIENT for start in begun}
        first = {start: _held(sum(int(part[1:].sum()) for part in since[start]), left[start]) for start in begun}
        times = {start: np.inf if back[start] else first[start] for start in begun}
    else:
        counted = [*begun[HIGH], *(~part for part in begun[LOW]), *map(_settled, held[RANDOM])]
        left = {
            HIGH: sum(int(np.count_nonzero(part[:-1] & ~part[1:])) for part in counted),
            LOW: sum(int(np.count_nonzero(~part[:-1] & part[1:])) for part in counted),
        }
        above = sum(int(part.sum()) for part in counted) - len(begun[HIGH])
        below = sum(int((~part).sum()) for part in counted) - len(begun[LOW])
        verdicts = {HIGH: _lasting(left[HIGH], left[LOW]), LOW: _lasting(left[LOW], left[HIGH])}
        times = {HIGH: _held(above, left[HIGH]), LOW: _held(below, left[LOW])}
    verdicts |= {start: Lasting.DIVERGED for start, gone in lost.items() if gone}
    share = np.nan if lined or any(lost.values()) else _share(times[HIGH], times[LOW])
    values = (verdicts[HIGH], verdicts[LOW], share, times[HIGH], times[LOW], float(np.mean(ended)) if ended else np.nan)
    return dict(zip(VERDICT, values, strict=True))


def _settled(held: np.ndarray) -> np.ndarray:
    """Motions that a random start holds from its first change on; all of them where it has none."""
    changes = np.flatnonzero(held[:-1] != held[1:])
    return held[changes[0] + 1 :] if len(changes) else held


def _lasting(left: int, come_back: int) -> Lasting:
    if not left:
        return Lasting.LASTING
    return Lasting.SWITCHING if come_back else Lasting.TRANSIENT


def _held(revolutions: int, left: int) -> float:
    return revolutions / left if left else (np.inf if revolutions else np.nan)


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
