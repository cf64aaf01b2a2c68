"""Steps of the workflow called from Python, on one core or on several: the numbers do not depend on how many."""

import threading
from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np
from threadpoolctl import threadpool_limits

from r37core.base.process_wide import ProcessWide
from r37core.config import ConfigError

from .stages import bar

Result = TypeVar("Result")


def check_cores(cores: int) -> None:
    """ConfigError for what is no number of cores."""
    if isinstance(cores, bool) or not isinstance(cores, int | np.integer) or cores < 1:
        raise ConfigError(f"cores: found {cores!r}; allowed: a whole number of at least 1")


def parallel_results(calls: Sequence[Callable[[], Result]], cores: int, what: str = "", unit: str = "") -> list[Result]:
    """Results of the calls, in their order, on so many processes. Raises what one of them raises.

    Each has one thread of the linear algebra library, so that the numbers are the workflow's to the last bit. With a `unit`,
    that they are counted by, a bar says how far they are. The processes are those of the backend that the caller has chosen by
    joblib's `parallel_config`, else of this machine.
    """
    processes, shown = min(cores, len(calls)), bar(calls, what, unit) if unit else calls
    if processes <= 1:
        with _alone():
            return [call() for call in shown]
    # imported here: what needs no other process does not wait for it
    from joblib import Parallel, delayed

    with _POOL:
        try:
            parallel = Parallel(n_jobs=processes, return_as="generator")
        except ValueError as error:
            raise ConfigError(f"joblib's backend: {error}; choose another, as loky, threading or dask") from None
        results = parallel(delayed(_called)(call) for call in calls)
        return [result for _, result in zip(shown, results, strict=True)]


def _called(call: Callable[[], Result]) -> Result:
    with _alone():
        return call()


_alone = ProcessWide(lambda: threadpool_limits(1))
"""While `_alone()` lasts, linear algebra has one thread: that of NumPy, since recipes see to the other library themselves."""

_POOL = threading.Lock()
"""Held by the thread that the worker processes work for: joblib has one set of them."""
