"""Smooth interpolation along the span of points with the same chordwise parameter."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline


class SpanLoft:
    """Cubic spline through the profiles, as weights: value(span) = sum over profiles of weight * profile value.

    `spans` are the profiles' span fractions, ascending; beyond them the end polynomials go on.
    """

    def __init__(self, spans: np.ndarray):
        self._spline = CubicSpline(spans, np.eye(len(spans)), bc_type="not-a-knot", extrapolate=True)
        self._slope = self._spline.derivative()

    def weights(self, span: np.ndarray) -> np.ndarray:
        """Weight of each profile, shape (points, profiles)."""
        return self._spline(span)

    def slopes(self, span: np.ndarray) -> np.ndarray:
        """Derivative of the weights with respect to the span fraction, shape (points, profiles)."""
        return self._slope(span)
