"""Limits of the model, and why runs are beyond them. Light: Snakemake's start imports it."""

from collections.abc import Mapping
from typing import Any

import numpy as np

_MOTION, _PAGE = "peak_share_of_height", "(docs/large_motion.md#limits)"

_LIMITS: dict[str, tuple[str | float, str]] = {
    _MOTION: (
        "share_of_height_limit",
        "the tip moves by up to {:.2g} of the blade's height; second order follows full finite elements to {:.2g} " + _PAGE,
    ),
    "largest_normal_force": (700.0, "contact forces reach {:.3g} N a node; at {:g} N a revolution is 9% off " + _PAGE),
    "energy_residual_share": (
        0.02,
        "up to {:.2g} of the energy put in is unaccounted for, above {:g}: a smaller time step changes the motion",
    ),
    "bounded_share_of_time": (
        0.0,
        "the motion grows until the bound on the elastic energy ends it, in up to {:.2g} of the steps: a smaller time step may "
        "diverge; a smaller friction.coefficient shows whether friction feeds it",
    ),
    "friction_power": ("melting_power", "friction dissipates up to {:.2g} W; a tenth of {:.2g} W melts the tip in a second"),
}
"""Variable of the runs -> its limit, of displacements of second order, or the variable that has it; the reason in words."""

OF_LIMITS = (*_LIMITS, *(limit for limit, _ in _LIMITS.values() if isinstance(limit, str)))
"""Variables that the limits are of."""


def beyond_limits(runs: Mapping[Any, Any]) -> np.ndarray:
    """True for the runs beyond any limit. `runs`: name -> numbers, all of one shape, NaN where they are not known."""
    return np.any(np.broadcast_arrays(*(_passed(runs, name) for name in _LIMITS)), axis=0)


def reasons_beyond_limits(runs: Mapping[Any, Any]) -> list[str]:
    """Reasons why runs are beyond limits, each with the numbers of the run that goes furthest; `runs`: see beyond_limits."""
    passed = {name: np.flatnonzero(_passed(runs, name)) for name in _LIMITS}
    reasons = []
    for name, places in passed.items():
        if places.size:
            values, limits = (
                np.broadcast_to(each, np.shape(runs[name])).flat[places] for each in (runs[name], _limit(runs, name))
            )
            furthest = values.argmax()
            reasons.append(_LIMITS[name][1].format(values[furthest], limits[furthest]))
    return reasons


def _passed(runs: Mapping[Any, Any], name: str) -> np.ndarray:
    return np.asarray(runs.get(name, np.nan)) > _limit(runs, name)


def _limit(runs: Mapping[Any, Any], name: str) -> np.ndarray:
    limit = _LIMITS[name][0]
    if isinstance(limit, str):
        return np.asarray(runs.get(limit, np.nan))
    return np.where(np.isfinite(runs.get(_MOTION, np.nan)), limit, np.inf)
