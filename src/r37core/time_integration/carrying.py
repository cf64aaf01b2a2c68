"""Motion of a blade as a run ends, carried into another run: at another speed, or in another lining."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy import ndarray

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel

from .integration_choice import IntegrationChoice
from .integrators import CENTRAL_DIFFERENCE
from .problem import Problem, stable_problem
from .segments import own_increments
from .state import SimulationState
from .status import RunStatus
from .step_limit import UnstableStepError

_LARGEST_TURN = 3.0
"""Largest turn of a mode in a step (rad) with which its velocity follows from two displacements."""

_MOTION = "carried_"
"""Beginning of the names of a motion's arrays, next to the numbers of the run that it ends."""

END_WEAR = f"{_MOTION}wear"
"""Name of the array of the wear that is carried."""

_KEPT = ("touched", "contact_force", "penetration", "bar_position")
"""Fields that a motion and a state have alike."""


@dataclass(frozen=True, eq=False)
class CarriedMotion:
    """Motion at the end of a run: where the next one begins.

    `displacement` and `velocity`: of the blade's modes at rest, then of an elastic casing's modes, shape (modes,). The rest is
    as in SimulationState; `wear` is None where the next run has a new lining, or none.
    """

    displacement: ndarray
    velocity: ndarray
    touched: ndarray
    contact_force: ndarray
    penetration: ndarray
    bar_position: ndarray
    wear: ndarray | None = None

    @classmethod
    def ended(cls, problem: Problem, state: SimulationState, *, keep_wear: bool = False) -> "CarriedMotion":
        """The motion of a `state`; `keep_wear`: whether the next run has the worn lining."""
        factors, blade = own_increments(problem), len(problem.blade.frequencies)
        velocity = factors.velocity(0, state.displacement, state.increment)
        displacement, velocity = (
            np.concatenate([problem.blade.modes @ part[:blade], part[blade:]]) for part in (state.displacement, velocity)
        )
        kept = {name: getattr(state, name).copy() for name in _KEPT}
        return cls(displacement, velocity, **kept, wear=state.wear.copy() if keep_wear and state.wear.size else None)

    @property
    def arrays(self) -> dict[str, ndarray]:
        """The motion as named arrays, of which `at_end` makes it again."""
        return {f"{_MOTION}{name}": part for name, part in vars(self).items() if part is not None}

    @classmethod
    def at_end(cls, numbers: Mapping[str, ndarray]) -> "CarriedMotion | None":
        """The motion among the numbers of a run; None of one that diverged."""
        if int(numbers["status"]) != RunStatus.COMPLETED:
            return None
        return cls(**{name.removeprefix(_MOTION): numbers[name] for name in motion_names(numbers)})

    def put(self, problem: Problem, state: SimulationState) -> None:
        """Put the motion into a state at rest, as far as the speed's modes are stepped."""
        factors, blade_modes = own_increments(problem), len(problem.blade.modes)
        displacement, velocity = (
            np.concatenate([problem.blade.modes.T @ part[:blade_modes], part[blade_modes:]])
            for part in (self.displacement, self.velocity)
        )
        problem.contact.put_followers(displacement, velocity)
        state.displacement, state.increment = displacement, factors.increment(0, displacement, velocity)
        for name in _KEPT:
            getattr(state, name)[...] = getattr(self, name)
        if self.wear is not None:
            # where the tip reaches into the lining at this speed, it has cut its way already
            np.maximum(state.wear, self.wear, out=state.wear)


def motion_names(numbers: Mapping[str, ndarray]) -> list[str]:
    """Names of the arrays of the motion among the numbers of a run."""
    return [name for name in numbers if name.startswith(_MOTION)]


def resolved_problem(model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice) -> Problem:
    """The problem at a speed (rad/s), with steps so short that the velocity of every mode follows from two displacements.

    Raises what Problem raises; UnstableStepError for an explicit step that is too long.
    """
    problem = stable_problem(model, speed, scene, choice)
    fastest = problem.contact.highest_frequency
    if choice.integrator == CENTRAL_DIFFERENCE or fastest * problem.grid.time_step < _LARGEST_TURN:
        return problem
    limit = _LARGEST_TURN / fastest
    if not choice.shorten:
        raise UnstableStepError(
            f"time_step_s: {choice.time_step:g} s; allowed where the speed changes: below {limit:.6g} s, so that the fastest "
            f"mode ({fastest / 2e3 / np.pi:.1f} kHz) turns by less than {_LARGEST_TURN:g} rad in a step",
            limit,
        )
    return resolved_problem(model, speed, scene, replace(choice, time_step=0.99 * limit))
