"""Limits of the model, why runs are beyond them, and from which revolution on. Light: Snakemake's start imports it."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy import ndarray

from r37core.time_integration.integration_choice import HEATED
from r37core.time_integration.status import Outcome

_MOTION, _PAGE = "peak_share_of_height", "(docs/large_motion.md#limits)"
_FED = "; with a smaller time step it may diverge, and a smaller friction.coefficient shows whether friction feeds it"


class Cause(Outcome):
    """Limit that a run leaves first."""

    NONE = 0
    HEIGHT = 1
    FORCE = 2
    HEAT = 3
    ENERGY = 4


class _Limit(NamedTuple):
    """A limit: its number, with displacements of second order, or the variable that has it; the reason in words.

    `brief`: the reason where it stands with others, with the number times a `factor`.
    `until`: array of a run's file with what the variable is in, or until the end of, each revolution; empty without one.
    """

    cause: Cause
    limit: str | float
    text: str
    brief: str
    factor: float
    until: str = ""


_LIMITS = {
    _MOTION: _Limit(
        Cause.HEIGHT,
        "share_of_height_limit",
        "the tip moves by up to {:.2g} of the blade's height; second order follows full finite elements to {:.2g} "
        + _PAGE
        + _FED,
        "height {:.3g}%",
        100.0,
        "revolution_share_of_height",
    ),
    # Static force on a patch of 4 mm of tip: 3% off full finite elements of large displacement at 2 kN, 10% at 3.6 kN. Of such
    # forces a bare casing puts a sixth on the end patch of 0.35 mm, in pulses of 10 us: it is 10% off at 0.3 kN.
    "largest_normal_force": _Limit(
        Cause.FORCE,
        2000.0,
        "contact forces reach {:.3g} N a node; from {:g} N on the tip's ends are 10% off full finite elements " + _PAGE,
        "force {:.3g} kN",
        1e-3,
        "force_so_far",
    ),
    "energy_residual_share": _Limit(
        Cause.ENERGY,
        0.02,
        "up to {:.2g} of the energy is unaccounted for, above {:g}: take a smaller time step",
        "energy {:.3g}%",
        100.0,
    ),
    "bounded_share_of_time": _Limit(
        Cause.ENERGY,
        0.0,
        "only the bound on the elastic energy ends the growth of the motion, in up to {:.2g} of the steps" + _FED,
        "bound on the energy in {:.3g}% of the steps",
        100.0,
        "bounded_so_far",
    ),
    "friction_power": _Limit(
        Cause.HEAT,
        "melting_power",
        "friction takes up to {:.3g} W over 20 revolutions; from {:.3g} W on the share of it that enters the tip "
        "(friction.heat_share) melts it in 1 s",
        "heat {:.3g} kW",
        1e-3,
    ),
    "friction_heat": _Limit(
        Cause.HEAT,
        "melting_power",
        "friction makes up to {:.3g} J of heat; from {:.3g} J on the share of it that enters the tip "
        "(friction.heat_share) melts it, if none flows off",
        "heat {:.3g} kJ",
        1e-3,
        "heat_so_far",
    ),
}
"""Variable of the runs -> its limit."""

OF_LIMITS = tuple(dict.fromkeys([*_LIMITS, *(each.limit for each in _LIMITS.values() if isinstance(each.limit, str))]))
"""Variables that the limits are of."""


def _excess(runs: Mapping[Any, Any], name: str) -> tuple[ndarray, ...]:
    """Numbers of all runs, their limits, and which are beyond."""
    limit = _LIMITS[name].limit
    fixed = (
        np.where(np.isfinite(runs.get(_MOTION, np.nan)), limit, np.inf) if isinstance(limit, float) else runs.get(limit, np.nan)
    )
    values, limits = np.broadcast_arrays(runs.get(name, np.nan), fixed)
    return values, limits, values > limits


def beyond_limits(runs: Mapping[Any, Any]) -> ndarray:
    """True for the runs beyond any limit. `runs`: name -> numbers, all of one shape, NaN where they are not known."""
    return np.any(np.broadcast_arrays(*(_excess(runs, name)[2] for name in _LIMITS)), axis=0)


def reasons_beyond_limits(runs: Mapping[Any, Any]) -> dict[str, str]:
    """Reasons why runs are beyond limits, in brief and in words, each with the number of the run that goes furthest.

    `runs`: see beyond_limits.
    """
    reasons = {}
    for name, known in _LIMITS.items():
        values, limits, beyond = _excess(runs, name)
        if beyond.any():
            furthest = np.where(beyond, values, -np.inf).argmax()
            worst = values.flat[furthest]
            reasons[known.brief.format(known.factor * worst)] = known.text.format(worst, limits.flat[furthest])
    return reasons


def first_revolutions_beyond(run: Mapping[str, ndarray]) -> dict[Cause, float]:
    """First revolution beyond each limit, by cause; infinite where there is none. `run`: arrays of its file.

    Energy that is unaccounted for is so from the first revolution on, and so is what is not known revolution by revolution. A
    mean power is known with its last revolution.
    """
    firsts = dict.fromkeys(list(Cause)[1:], np.inf)
    for name, known in _LIMITS.items():
        _, limit, beyond = _excess(run, name)
        if not beyond.any():
            continue
        first = 1.0
        if name == "friction_power" and "heat_so_far" in run:
            first = _first_hot_revolution(run["heat_so_far"], float(limit) * 2.0 * np.pi / float(run["speed"]))
        elif known.until in run:
            above = run[known.until] > limit
            first = float(above.argmax()) + 1.0 if above.any() else 1.0
        firsts[known.cause] = min(firsts[known.cause], first)
    return firsts


def _first_hot_revolution(heat: ndarray, most: float) -> float:
    """Last revolution of the first HEATED ones that make more than `most` heat (J) a revolution."""
    made = np.concatenate([[0.0], heat[np.isfinite(heat)]])
    window = max(min(HEATED, len(made) - 1), 1)
    hot = made[window:] - made[:-window] >= window * most
    return float(hot.argmax() + window)
