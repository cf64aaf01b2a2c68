"""One published number next to ours."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Check:
    """One published number next to ours, or a yes or no; `within`: relative error up to which it counts as agreeing.

    `detail`: the number behind a yes or no.
    """

    name: str
    published: float | str
    ours: float | str
    unit: str = ""
    within: float = 0.01
    detail: str = ""

    @property
    def error(self) -> float:
        """Relative error; infinite where a yes or no differs or there is no number of ours."""
        if isinstance(self.published, str) or isinstance(self.ours, str):
            return 0.0 if self.published == self.ours else np.inf
        return abs(self.ours / self.published - 1.0) if np.isfinite(self.ours) else np.inf

    @property
    def agrees(self) -> bool:
        """Whether the error is within what is asked."""
        return self.error <= self.within

    @property
    def verdict(self) -> str:
        """Whether it agrees, as text."""
        return "yes" if self.agrees else "no"

    @property
    def percent(self) -> str:
        """The error of a number as text; nothing for a yes or no."""
        if isinstance(self.published, str):
            return ""
        return "none" if np.isinf(self.error) else f"{100 * self.error:.2g}%"

    @property
    def shown(self) -> str:
        """Ours as text."""
        return number(self.ours) + (f" ({self.detail})" if self.detail else "")


def claim(name: str, truth: bool, detail: str = "") -> Check:
    """A published statement, which agrees if it is true of ours."""
    return Check(name, "yes", "yes" if truth else "no", detail=detail)


def number(value: float | str) -> str:
    """A number in five digits, `none` for NaN, text as it is."""
    if isinstance(value, str):
        return value
    return f"{value:.5g}" if np.isfinite(value) else "none"


def score(checks: Iterable[Check]) -> str:
    """How many agree, of all."""
    verdicts = [check.agrees for check in checks]
    return f"{sum(verdicts)} of {len(verdicts)}"
