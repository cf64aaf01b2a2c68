"""One published number next to ours."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Check:
    """One published number next to ours, or a yes or no; `within`: relative error up to which it counts as agreeing.

    `published` None: the number is ours alone, nothing is scored; `detail`: the number behind a yes or no.
    """

    name: str
    published: float | str | None
    ours: float | str
    unit: str = ""
    within: float = 0.01
    detail: str = ""

    @property
    def error(self) -> float:
        """Relative error; infinite where a yes or no differs or there is no number of ours; 0 without a published one."""
        if self.published is None:
            return 0.0
        if isinstance(self.published, str) or isinstance(self.ours, str):
            return 0.0 if self.published == self.ours else np.inf
        return abs(self.ours / self.published - 1.0) if np.isfinite(self.ours) else np.inf

    @property
    def agrees(self) -> bool:
        """Whether the error is within what is asked."""
        return self.error <= self.within

    @property
    def verdict(self) -> str:
        """`yes` or `no`: whether it agrees; nothing where nothing is published."""
        return "" if self.published is None else "yes" if self.agrees else "no"

    @property
    def percent(self) -> str:
        """The error of a number as text; nothing for a yes or no, or without a published number."""
        if self.published is None or isinstance(self.published, str):
            return ""
        return "none" if np.isinf(self.error) else f"{100 * self.error:.2g}%"

    @property
    def shown(self) -> str:
        """Ours as text."""
        return number(self.ours) + (f" ({self.detail})" if self.detail else "")


def claim(name: str, truth: bool, detail: str = "") -> Check:
    """A published statement, which agrees if it is true of ours."""
    return Check(name, "yes", "yes" if truth else "no", detail=detail)


def number(value: float | str | None) -> str:
    """A number in five digits, `none` for NaN, nothing for None, text as it is."""
    if value is None or isinstance(value, str):
        return value or ""
    return f"{value:.5g}" if np.isfinite(value) else "none"


def score(checks: Iterable[Check]) -> str:
    """Number of published numbers that agree, and of all."""
    published = [check for check in checks if check.published is not None]
    return f"{sum(check.agrees for check in published)} of {len(published)}"
