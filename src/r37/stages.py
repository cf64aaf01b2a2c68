"""Progress of a call: a line for each stage, a bar for many simulations.

The lines go to the logger `r37` of the standard library. Where nobody listens to it and a person watches, on a terminal or in a
notebook, they are written there, and bars beside them. `logging.getLogger("r37").setLevel("WARNING")` silences both.
"""

from __future__ import annotations

import logging
import sys
import warnings
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeVar

from r37core.base.process_wide import ProcessWide

if TYPE_CHECKING:
    from r37core.config import Settings

LOGGER = logging.getLogger("r37")

T = TypeVar("T")


def _watched() -> bool:
    """True where a person sees what is written now, and has not asked for quiet."""
    if LOGGER.level > logging.INFO or sys.stderr is None:
        return False
    return sys.stderr.isatty() or type(sys.stderr).__module__.startswith("ipykernel")


@contextmanager
def _written() -> Iterator[None]:
    taken = LOGGER.isEnabledFor(logging.INFO) and LOGGER.hasHandlers()
    if taken or not _watched():
        yield
        return
    handler, level, propagate = logging.StreamHandler(sys.stderr), LOGGER.level, LOGGER.propagate
    LOGGER.addHandler(handler)
    LOGGER.setLevel(logging.INFO)
    # handlers that others gave the root would write the line once more
    LOGGER.propagate = False
    try:
        yield
    finally:
        LOGGER.removeHandler(handler)
        LOGGER.setLevel(level)
        LOGGER.propagate = propagate


stages = ProcessWide(_written)
"""While `stages()` lasts, or a call with the decorator `@stages()`, lines of the logger are written where a person watches and
nobody else takes them."""


def bar(items: Collection[T], what: str, unit: str) -> Iterable[T]:
    """The items one after another, with a bar that says how many are done and how long the others take, where it is watched."""
    return items if len(items) < 2 or not _watched() else _tqdm(items, desc=what, unit=unit)


def job_bar() -> Any:
    """A bar of the jobs of a workflow, of which more become known while it runs, shown where it is watched."""
    return _tqdm(desc="jobs", unit="job", disable=not _watched())


def _tqdm(items: Iterable[Any] | None = None, **more: Any) -> Any:
    with warnings.catch_warnings():
        # a notebook without ipywidgets has a bar of characters, which is as good
        warnings.simplefilter("ignore")
        from tqdm.auto import tqdm
    return tqdm(items, delay=0.5, leave=False, file=sys.stderr, **more)


def simulations_in_words(settings: Settings, blade: str, scene: str, number: str) -> str:
    """The line of a stage that simulates."""
    plural = "" if number == "1" else "s"
    return f"{blade} in {scene}: {number} simulation{plural}, level {settings.fidelity_name}"
