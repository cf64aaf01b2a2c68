"""End of a run: whether it has settled, and whether its motion grows, lasts or has cut itself free there.

Both are read off windows of revolutions: a run's last one, and the one before it.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy import ndarray

from .integration_choice import IntegrationChoice
from .status import Outcome

WINDOW = 50
"""Revolutions of a window, fewer in runs that have less than four of them."""

NO_WEAR = 1e-8
"""Growth of a bar's wear (m) in a window that counts as none: a hundred thousandth of what an interaction wears."""

SAME, SAME_OF_LARGEST = 0.01, 0.001
"""Difference of the rms of two windows that counts as none: a share of the larger one, or of the largest of the run."""

DRIFT, WINDOWS_AHEAD = 0.02, 20
"""Share of the last window by which its motion may still drift, and windows that a drift is followed for: the longest run."""

STILL_WEARING = 0.01
"""Growth of a bar's wear in the last window, as a share of the largest wear, above which a run still changes."""

SCATTERS = 2.0
"""Standard deviations of the revolutions of a window by which the next one has to be larger to count as growing."""

DECAYED = 0.1
"""Share of the largest rms of a revolution below which the motion at the end is over."""


class MotionAtEnd(Outcome):
    """State of the motion at the end of a run, the worst last; see motion_at_end.

    `UNKNOWN`: of a run that diverged, and of a speed that was not run.
    """

    QUIET = 0
    CUT_FREE = 1
    LASTING = 2
    GROWING = 3
    UNKNOWN = 4


@dataclass(frozen=True)
class Ending:
    """End of a run: `revolutions` done, and whether it had `settled` then.

    `wear_growth` (m): largest growth of a bar's wear in the last window; `contact_steps`: steps with a contact force in it.
    NaN where they are not known, as of a rotor.
    """

    revolutions: int
    settled: bool = False
    wear_growth: float = np.nan
    contact_steps: float = np.nan


def window_of(revolutions: int) -> int:
    """Revolutions of a window of a run."""
    return min(WINDOW, max(revolutions // 4, 1))


def revolution_rms(motion: ndarray, per_revolution: int) -> ndarray:
    """Rms of a motion in several directions together in each revolution, shape (revolutions,).

    `motion`, shape (samples, directions), with `per_revolution` samples in a revolution; NaN stays.
    """
    return np.sqrt(np.einsum("ij,ij->i", motion, motion).reshape(-1, per_revolution).mean(axis=1))


def has_settled(rms: ndarray, window: int, wear_growth: float, risen: float) -> bool:
    """True where the last window of a run brought no wear and no change of the motion, and no slow drift goes on.

    That is: no bar wore by more than NO_WEAR, and the rms of the last window differs from that of the window before by less
    than SAME of the larger one, or than SAME_OF_LARGEST of the largest of all windows; and it drifts by no more than DRIFT,
    unless it has DECAYED. `rms` (m) of each revolution, shape (revolutions,); `wear_growth` (m), see Ending; `risen`:
    revolutions after which the lobes have grown, before which nothing has settled.
    """
    if len(rms) < 2 * window or len(rms) - 2 * window < risen or not wear_growth <= NO_WEAR:
        return False
    windows = np.sqrt(np.mean(np.reshape(rms[len(rms) % window :] ** 2, (-1, window)), axis=1))
    before, last = windows[-2:]
    alike = abs(last - before) <= max(SAME * max(before, last), SAME_OF_LARGEST * windows.max())
    return bool(alike and (last < DECAYED * windows.max() or abs(remaining_drift(rms[math.ceil(risen) :], window)) <= DRIFT))


def remaining_drift(values: ndarray, window: int) -> float:
    """Relative change that the means of the last three windows lead to within WINDOWS_AHEAD.

    `values`, positive, shape (revolutions,). Two equal steps go on as they are, smaller ones shrink by the same ratio; of two
    windows the step between them goes on. 0 where they go up and down, or change by less than the last one's revolutions
    scatter.
    """
    means = np.reshape(values[len(values) % window :], (-1, window)).mean(axis=1)[-3:]
    *earlier, step = np.diff(means)
    if abs(means[-1] - means[0]) <= SCATTERS * values[-window:].std() or (earlier and earlier[0] * step <= 0.0):
        return 0.0
    ratio = min(step / earlier[0], 1.0) if earlier else 1.0
    return max(float(step * np.sum(ratio ** np.arange(1, WINDOWS_AHEAD + 1)) / means[-1]), -1.0)


def motion_at_end(
    rms: ndarray, clearance: float, max_wear: float = 0.0, wear_growth: float = np.nan, contact_steps: float = np.nan
) -> MotionAtEnd:
    """State of the motion at the end of a run, by the `rms` (m) of each of its revolutions, shape (revolutions,).

    Growing: the mean rms of the last window is above that of the window before by more than SCATTERS standard deviations of
    the revolutions about these means and by more than SAME; or a bar wears by more than NO_WEAR and STILL_WEARING of the
    largest wear in it. Quiet: no revolution's rms is above the `clearance` (m). Cut free: it was, but the last revolution's is
    below DECAYED of the largest, or nothing was in contact in the last window. Lasting: all else. `max_wear` (m): the largest;
    `wear_growth`, `contact_steps`: see Ending, NaN where they are not known.
    """
    if not np.isfinite(rms).all():
        return MotionAtEnd.UNKNOWN
    window, largest = window_of(len(rms)), rms.max()
    last = rms[-window:]
    before = rms[-2 * window : -window] if len(rms) >= 2 * window else rms[:1]
    scatter = float(np.sqrt(0.5 * (last.var() + before.var())))
    growth = last.mean() - before.mean()
    if growth > max(SCATTERS * scatter, SAME * last.mean()) and largest > clearance:
        return MotionAtEnd.GROWING
    if wear_growth > max(NO_WEAR, STILL_WEARING * max_wear):
        return MotionAtEnd.GROWING
    if not largest > clearance:
        return MotionAtEnd.QUIET
    return MotionAtEnd.CUT_FREE if rms[-1] < DECAYED * largest or contact_steps == 0.0 else MotionAtEnd.LASTING


def parts_of_run(choice: IntegrationChoice) -> list[int]:
    """Revolutions of a run's parts: the last is a window, and so are all but the first where it may end after any.

    Else the statistic begins with the second.
    """
    window, later = window_of(choice.revolutions), choice.revolutions_in_statistic
    if not choice.until_settled:
        return [part for part in (choice.revolutions - later, later - window, window) if part]
    return [choice.revolutions % window + window, *[window] * (choice.revolutions // window - 1)]
