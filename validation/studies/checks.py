"""One published number beside ours, and tables of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr

from validation.studies.tables import markdown_table


@dataclass(frozen=True)
class Check:
    """One published number beside ours, or a yes or no; `within`: relative error up to which it counts as agreeing.

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


def score(checks: Sequence[Check]) -> str:
    """How many of the published numbers agree."""
    published = [check for check in checks if check.published is not None]
    return f"{sum(check.agrees for check in published)} of {len(published)}"


def validation_table(checks: Sequence[Check], others: Mapping[str, Sequence[Check]]) -> str:
    """All checks, those that differ first, by falling error, those without a published number last.

    `others`: by name, the same checks with one numerical choice changed, as far as they have them.
    """
    head = ["what", "published", "ours", "error", *(name.replace("_", " ") for name in others)]
    rows = []
    shown = [{check.name: check.shown for check in several} for several in others.values()]
    for check in sorted(checks, key=lambda check: (check.published is None, check.agrees, -check.error)):
        published = number(check.published)
        unit = f" {check.unit}" if check.unit and published else ""
        rows.append(
            [check.name, published + unit, check.shown, _error(check), *(values.get(check.name, "") for values in shown)]
        )
    return f"{score(checks)} published numbers and statements agree.\n\n{markdown_table(head, rows)}"


def _error(check: Check) -> str:
    if check.published is None:
        return ""
    if isinstance(check.published, str):
        return "" if check.agrees else "**differs**"
    text = "none" if np.isinf(check.error) else f"{100 * check.error:.2g}%"
    return text if check.agrees else f"**{text}**"


def ran(response: xr.Dataset, name: str) -> xr.Dataset:
    """The response of a case that a study cannot do without; ValueError with the reason if it was refused."""
    if "refused" in response.attrs:
        raise ValueError(f"{name}: {response.attrs['refused']}")
    return response


def energy_share(response: xr.Dataset) -> np.ndarray:
    """What the energy balance does not close, as a share of all that went in and out, shape (speeds,)."""
    turned_over = np.abs(response["contact_work"].values) + response["damping_loss"].values
    residual = response["energy_residual"].values
    return np.divide(residual, turned_over, out=np.zeros_like(residual), where=turned_over > 0.0)


def with_histories(run: xr.Dataset, other: xr.Dataset) -> xr.Dataset:
    """A response with the stress histories of another one of the same blade and scene beside its own."""
    histories = [each["max_von_mises_history"] for each in (run, other) if "max_von_mises_history" in each]
    together = xr.concat(histories, "history_speed").drop_duplicates("history_speed").sortby("history_speed")
    return run.drop_dims("history_speed", errors="ignore").assign(max_von_mises_history=together)
