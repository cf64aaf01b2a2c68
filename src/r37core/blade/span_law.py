"""A number that follows the span: the same everywhere, linear from hub to tip, or a table at stations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy


@dataclass(frozen=True)
class SpanLaw:
    """Values at `spans`, fractions that rise from 0 to 1; a single value is the same over the whole span."""

    spans: tuple[float, ...]
    values: tuple[float, ...]

    @classmethod
    def constant(cls, value: float) -> SpanLaw:
        """Constant law: one value at every span."""
        return cls((0.0,), (value,))

    @classmethod
    def linear(cls, hub: float, tip: float) -> SpanLaw:
        """Linear law: in proportion to the span from hub to tip."""
        return cls((0.0, 1.0), (hub, tip))

    def evaluate(self, spans: Sequence[float]) -> np.ndarray:
        """Values at span fractions, shape (spans,): a spline as that of sweep and lean, at most cubic.

        Equal values give themselves to the last bit, so that a law of neutral values changes nothing.
        """
        if len(set(self.values)) == 1:
            return np.full(len(spans), self.values[0])
        order = min(3, len(self.values) - 1)
        spline = scipy.interpolate.make_interp_spline(self.spans, self.values, k=order)
        return np.asarray(spline(np.asarray(spans)))
