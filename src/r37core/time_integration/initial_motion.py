"""A run that starts in motion: displacement and velocity of the reduced model as a state of the time integration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from r37core.rom.contact_model import ContactModel

from .integrators import increments
from .state import SimulationState

if TYPE_CHECKING:
    from .problem import Problem

_TOUCHING = 1e-12
"""Depth (m) up to which a node lies on the casing or lining, and not in it."""


class InitialMotionError(ValueError):
    """A displacement or velocity that a run cannot start with."""


@dataclass(frozen=True, eq=False)
class InitialMotion:
    """Displacement and velocity of a blade as its run starts, in the coordinates of the reduced model.

    `displacement`, whose first numbers are those of the contact nodes in m (see ReducedModel), and `velocity`, the same per
    second, shape (coordinates,); None for none. They are those of the vibration, about the position where rotation holds the
    blade. Raises InitialMotionError for what is no list of finite numbers.
    """

    displacement: np.ndarray | None
    velocity: np.ndarray | None

    @classmethod
    def from_arrays(cls, displacement: ArrayLike | None, velocity: ArrayLike | None) -> InitialMotion | None:
        """The motion with these; None where there is neither."""
        if displacement is None and velocity is None:
            return None
        return cls(_numbers("displacement", displacement), _numbers("velocity", velocity))

    @property
    def attributes(self) -> dict[str, str | np.ndarray]:
        """Attributes of a dataset about the initial motion; none for a blade at rest."""
        parts = {"initial_displacement": self.displacement, "initial_velocity": self.velocity}
        named = {name: part for name, part in parts.items() if part is not None and part.any()}
        return {"initial_state": "in motion", **named} if named else {}

    def rest_coordinates(self, model: ContactModel) -> np.ndarray:
        """Displacement and velocity in the modes at rest, shape (2, modes); InitialMotionError if the model has others."""
        size = len(model.to_reduced)
        motion = np.zeros((2, size))
        for row, name in enumerate(("displacement", "velocity")):
            part = getattr(self, name)
            if part is not None and len(part) != size:
                raise InitialMotionError(
                    f"initial_{name}: found {len(part)} numbers; allowed: {size}, one for each coordinate of the reduced model"
                )
            motion[row] = 0.0 if part is None else part
        return np.linalg.lstsq(model.to_reduced, motion.T, rcond=None)[0].T

    def left_out(self, problem: Problem) -> float:
        """Share of its energy that a run leaves out, because it lies in modes that are not stepped."""
        whole, model = self.rest_coordinates(problem.model), problem.model
        rest = whole - (whole @ problem.blade.modes) @ problem.blade.modes.T

        frequencies, modes = model.modes_at(problem.speed)

        def energy(motion: np.ndarray) -> float:
            displacement, velocity = motion
            return float(velocity @ velocity + np.sum((frequencies * (displacement @ modes)) ** 2))

        with np.errstate(over="ignore", invalid="ignore"):
            total = energy(whole)
        if not np.isfinite(total):
            raise InitialMotionError("initial_displacement, initial_velocity: found an energy without bound; allowed: less")
        return energy(rest) / total if total > 0.0 else 0.0

    def put(self, problem: Problem, state: SimulationState) -> None:
        """Put the motion into a state at rest, as far as the modes are stepped.

        The increment u_0 - u_{-1} is that of free motion through displacement and velocity, in closed form with exact_modal;
        with central differences the velocity is (u_1 - u_{-1})/(2h). Static modes follow contact forces, and there are none.
        Raises InitialMotionError for a displacement that does not fit, and for one that reaches into casing or lining.
        """
        displacement, velocity = self.rest_coordinates(problem.model) @ problem.blade.modes
        if self.displacement is not None:
            _check_room(problem, displacement, state)
        blade = slice(len(displacement))
        own, step = problem.blade.frequencies, problem.grid.time_step
        factors = increments(problem.choice.integrator, own, problem.scene.damping(own, problem.speed), step)
        problem.contact.put_followers(displacement, velocity)
        increment = factors.displacement_factor * displacement + factors.velocity_factor * velocity
        if problem.contact.quadratic is not None:
            # forces kick at an instant, and the velocity is that in the middle of the kick
            stepping = problem.blade.recursion
            increment -= stepping.inverse * problem.contact.quadratic.force(displacement) / (1.0 + stepping.keep)
        state.displacement[blade], state.increment[blade] = displacement, increment


def _numbers(name: str, values: ArrayLike | None) -> np.ndarray | None:
    if values is None:
        return None
    allowed = "allowed: finite numbers in a row, one for each coordinate of the reduced model"
    try:
        numbers = np.asarray(values)
    except ValueError:
        raise InitialMotionError(f"initial_{name}: found rows of different lengths; {allowed}") from None
    if numbers.ndim != 1:
        raise InitialMotionError(f"initial_{name}: found an array of shape {numbers.shape}; {allowed}")
    if numbers.dtype.kind not in "iuf":
        raise InitialMotionError(f"initial_{name}: found entries of kind {numbers.dtype.name}; {allowed}")
    wrong = np.flatnonzero(~np.isfinite(numbers))
    if len(wrong):
        raise InitialMotionError(f"initial_{name}: found {numbers[wrong[0]]} at place {wrong[0]}, counted from 0; {allowed}")
    return numbers.astype(float)


def _check_room(problem: Problem, displacement: np.ndarray, state: SimulationState) -> None:
    """InitialMotionError where a `displacement` of the stepped modes brings a node into casing or lining.

    The contact forces of the first instant would be missing.
    """
    nodes = np.array([rows @ (problem.blade.modes @ displacement) for rows in problem.contact.operator_at_rest])
    if problem.contact.quadratic is not None:
        nodes += problem.contact.product_operator @ problem.contact.quadratic.products(displacement)
    room, _ = problem.casing.gaps(problem.casing.clearance, nodes, 0, 0.0)
    # of no bars without a lining; as a run starts, those of a ring are worn alike
    room = room + state.wear[:, :1].sum(axis=1)
    node = int(room.argmin())
    if room[node] < -_TOUCHING:
        raise InitialMotionError(
            f"initial_displacement: contact node {node + 1} of {len(room)}, from the leading edge on, would start "
            f"{-room[node]:.3g} m inside of the casing or lining; allowed: a displacement that reaches neither"
        )
