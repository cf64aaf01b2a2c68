"""Events of a run by revolution: when it leaves the model's limits, and when its stress passes yield or the Goodman line.

What comes before the exit is sound, whatever comes after. So a speed is dangerous where a limit of the stress is passed inside
the model, unknown where the model is left first, else below.
"""

from collections.abc import Mapping

import numpy as np
from numpy import ndarray

from r37core.base.variable import Variable
from r37core.stress.statistic import Strengths, goodman_history
from r37core.time_integration.status import Outcome, RunStatus

from .limits import Cause, first_revolutions_beyond

_REGION = ("region",)


class Danger(Outcome):
    """Danger of a speed: whether a limit of the stress is passed inside the model."""

    BELOW = 0
    UNKNOWN = 1
    DANGEROUS = 2


def _declared(limit: str, words: str) -> dict[str, Variable]:
    """Variables of the events of one limit of the stress, `words` its name."""
    return {
        f"first_{limit}_revolution": Variable(_REGION, "1", f"first revolution above {words}, NaN where there is none"),
        f"revolutions_above_{limit}": Variable(_REGION, "1", f"number of revolutions above {words}, of all of the run"),
        f"{limit}_danger": Variable(_REGION, "1", f"whether {words} is passed inside the model's limits", "i1", Danger),
    }


OF_EXIT = {
    "exit_revolution": Variable((), "1", "first revolution beyond any of the model's limits, NaN where there is none"),
    "exit_cause": Variable((), "1", "limit that is left first", "i1", Cause),
}
OF_YIELD = {
    **_declared("yield", "yield"),
    "max_von_mises_inside": Variable(
        _REGION, "Pa", "largest von Mises stress in the region before the model's limits are left"
    ),
}
OF_GOODMAN = {
    **_declared("goodman", "the Goodman line"),
    "goodman_share_inside": Variable(_REGION, "1", "largest share of the Goodman line before the model's limits are left"),
}


def exit_of(run: Mapping[str, ndarray]) -> dict[str, ndarray]:
    """OF_EXIT of a run, by the arrays of its file."""
    firsts = first_revolutions_beyond(run)
    cause = min(firsts, key=firsts.__getitem__)
    left = np.isfinite(firsts[cause])
    return {
        "exit_revolution": np.array(firsts[cause] if left else np.nan),
        "exit_cause": np.array(cause if left else Cause.NONE),
    }


def events_of(history: ndarray, limit: float, first: int, exit_revolution: float, diverged: float) -> tuple[ndarray, ...]:
    """Events of one limit: its first revolution, their number, a Danger and the largest value inside the model, by region.

    `history`, shape (regions, revolutions), of the revolutions from number `first` on, NaN after the end; one that `diverged`
    in a revolution, NaN where it did not, has passed every limit there. A limit that is passed in the very revolution of the
    exit may have been passed after it: the speed is unknown.
    """
    revolution = first + np.arange(history.shape[1])
    left, ended = np.nan_to_num(exit_revolution, nan=np.inf), np.nan_to_num(diverged, nan=np.inf)
    above = history > limit
    passed = np.minimum(np.where(above, revolution, np.inf).min(axis=1, initial=np.inf), np.ceil(ended))
    inside = np.max(history, where=(revolution < left) & np.isfinite(history), axis=1, initial=0.0)
    danger = np.where(passed < left, Danger.DANGEROUS, np.where(left < np.inf, Danger.UNKNOWN, Danger.BELOW))
    return np.where(np.isfinite(passed), passed, np.nan), above.sum(axis=1), danger, inside


def yield_events(run: Mapping[str, ndarray], yield_stress: float, exit_revolution: float) -> dict[str, ndarray]:
    """OF_YIELD of a run, by the arrays of its file; yield in Pa."""
    values = _history_events(run, run["revolution_von_mises"], yield_stress, exit_revolution)
    return dict(zip(OF_YIELD, values, strict=True))


def goodman_events(run: Mapping[str, ndarray], strengths: Strengths, exit_revolution: float) -> dict[str, ndarray]:
    """OF_GOODMAN of a run, by the arrays of its file."""
    return dict(zip(OF_GOODMAN, _history_events(run, goodman_history(run, strengths), 1.0, exit_revolution), strict=True))


def _history_events(run: Mapping[str, ndarray], history: ndarray, limit: float, exit_revolution: float) -> tuple[ndarray, ...]:
    """Events of a history that has all revolutions, or the last ones, of a run."""
    revolutions = len(run["revolution_maximum"])
    # one of all revolutions has them in place, one of those that were done ends with the last
    first = 1 if history.shape[1] == revolutions else int(run["statistic_end"]) - history.shape[1] + 1
    diverged = float(run["diverged_revolution"]) if run["status"] == RunStatus.DIVERGED else np.nan
    return events_of(history, limit, first, exit_revolution, diverged)
