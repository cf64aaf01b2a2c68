"""Limits of the model, and why runs are beyond them. Light: Snakemake's start imports it."""

from collections.abc import Mapping
from typing import Any

import numpy as np

_MOTION, _PAGE = "peak_share_of_height", "(docs/large_motion.md#limits)"
_FED = "; with a smaller time step it may diverge, and a smaller friction.coefficient shows whether friction feeds it"

_LIMITS: dict[str, tuple[str | float, str]] = {
    _MOTION: (
        "share_of_height_limit",
        "the tip moves by up to {:.2g} of the blade's height; second order follows full finite elements to {:.2g} "
        + _PAGE
        + _FED,
    ),
    "largest_normal_force": (700.0, "contact forces reach {:.3g} N a node; tested to {:g} N, there 9% off " + _PAGE),
    "energy_residual_share": (0.02, "up to {:.2g} of the energy is unaccounted for, above {:g}: take a smaller time step"),
    "bounded_share_of_time": (
        0.0,
        "only the bound on the elastic energy ends the growth of the motion, in up to {:.2g} of the steps" + _FED,
    ),
    "friction_power": ("melting_power", "friction takes up to {:.3g} W; from {:.3g} W on a tenth of it melts the tip in 1 s"),
}
"""Variable of the runs -> its limit, with displacements of second order, or the variable that has it; the reason in words."""

OF_LIMITS = (*_LIMITS, *(limit for limit, _ in _LIMITS.values() if isinstance(limit, str)))
"""Variables that the limits are of."""


def _excess(runs: Mapping[Any, Any], name: str) -> tuple[np.ndarray, ...]:
    """Numbers of all runs, their limits, and which are beyond."""
    limit = _LIMITS[name][0]
    fixed = (
        np.where(np.isfinite(runs.get(_MOTION, np.nan)), limit, np.inf) if isinstance(limit, float) else runs.get(limit, np.nan)
    )
    values, limits = np.broadcast_arrays(runs.get(name, np.nan), fixed)
    return values, limits, values > limits


def beyond_limits(runs: Mapping[Any, Any]) -> np.ndarray:
    """True for the runs beyond any limit. `runs`: name -> numbers, all of one shape, NaN where they are not known."""
    return np.any(np.broadcast_arrays(*(_excess(runs, name)[2] for name in _LIMITS)), axis=0)


def reasons_beyond_limits(runs: Mapping[Any, Any]) -> list[str]:
    """Reasons why runs are beyond limits, each with the numbers of the run that goes furthest; `runs`: see beyond_limits."""
    reasons = []
    for name, (_, text) in _LIMITS.items():
        values, limits, beyond = _excess(runs, name)
        if beyond.any():
            furthest = np.where(beyond, values, -np.inf).argmax()
            reasons.append(text.format(values.flat[furthest], limits.flat[furthest]))
    return reasons
