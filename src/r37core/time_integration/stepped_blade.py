"""The blade of a run: which of its modes are stepped, and how they move between contacts."""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy import ndarray

from r37core.contact.casing import casing_axes
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel

from .integration_choice import IntegrationChoice
from .integrators import Recursion, recursion
from .static_modes import residual_flexibility, stepped_modes
from .step_limit import largest_pressed_ratio, ratio_of_pressed_nodes
from .time_grid import TimeGrid

_TURN_OF_FOLLOWERS, _FASTER = 0.5, 16.0
"""Largest turn of a follower in a step (rad), far from the limit of stability, and its frequency over that of the first mode.

It lags behind what it follows, at twice the frequency of the first mode, by the square of 2/16.
"""

_STRETCHING = 0.05
"""Share of the first mode's inertia of second order from which a mode stretches: stepped, it would stiffen a step too much."""

_SMALLEST_FOLLOWER = 1e-9
"""Smallest mass of a follower, as a share of the largest."""


@dataclass(frozen=True, eq=False)
class SteppedBlade:
    """Modes of a blade's `model` at the speed of a `grid`, in a `scene` whose casing has the `cone_angle` (rad).

    With the integrator exact_modal modes faster than `grid.choice.static_above` per step follow the forces statically: they
    are none of `frequencies` and `modes`; see r37core.time_integration.static_modes. With central differences all modes are
    stepped. Of a model with displacements of second order followers are stepped behind the modes, see `followers`.
    """

    model: ContactModel
    scene: Scene
    grid: TimeGrid
    cone_angle: float

    @cached_property
    def frequencies(self) -> ndarray:
        """Frequencies of the modes that are stepped (rad/s), ascending; then those of followers."""
        own = self._modes_of_speed[0][: self._stepped]
        followers = self.followers.shape[1]
        fastest = min(_TURN_OF_FOLLOWERS / self.grid.time_step, _FASTER * float(own[0]))
        return np.append(own, np.full(followers, fastest)) if followers else own

    @cached_property
    def modes(self) -> ndarray:
        """Modes of this speed that are stepped, shape (modes at rest, modes); followers have no part of those at rest."""
        own = np.ascontiguousarray(self._modes_of_speed[1][:, : self._stepped])
        followers = self.followers.shape[1]
        return np.pad(own, ((0, 0), (0, followers))) if followers else own

    @cached_property
    def derivatives(self) -> ndarray:
        """Static derivatives of the lowest modes in all modes of the speed, shape (products, modes); none of a linear model."""
        terms, logarithmic = self.model.quadratic, self.model.logarithmic_stiffness
        if terms is None or logarithmic is None:
            return np.empty((0, len(self._modes_of_speed[0])))
        return terms.interpolated(logarithmic.abscissa(self.grid.speed))[0] @ self._modes_of_speed[1]

    @cached_property
    def followers(self) -> ndarray:
        """Inertia of the static modes that follow products of second order, shape (products, followers).

        A follower is a mode without displacement that is pulled to where the static modes are, and has their mass: static
        derivatives of the followers whose products with each other are those of the static modes. Without it the stiffness of
        second order would lack the inertia that nearly cancels it.
        """
        static = self.derivatives[:, self._stepped :]
        squares, shapes = np.linalg.eigh(static @ static.T)
        kept = squares > _SMALLEST_FOLLOWER * max(squares.max(initial=0.0), np.finfo(float).tiny)
        return shapes[:, kept] * np.sqrt(squares[kept])

    @cached_property
    def _stepped(self) -> int:
        """Number of modes that are stepped: with central differences all up to the highest frequency, else see static_modes."""
        frequencies, _ = self._modes_of_speed
        below = int(np.count_nonzero(frequencies <= 2.0 * np.pi * self.grid.choice.highest_frequency))
        if below == 0:
            raise ValueError(
                f"time_integration.highest_frequency_hz of the fidelity level: found {self.grid.choice.highest_frequency:g}; "
                f"allowed: more than the first mode's, {frequencies[0] / 2.0 / np.pi:.6g} Hz at {self.grid.speed:g} rad/s"
            )
        if not self.grid.choice.second_order:
            return below
        if self.model.quadratic is not None:
            inertia, lowest = self.derivatives[0] ** 2, len(self.model.quadratic.coordinates)
            below = min(below, lowest + int(np.argmax(inertia[lowest:] > _STRETCHING * inertia.sum())))
        return _stepped_at_rest(self.model, self.scene, self.grid.choice, self.cone_angle, below)

    @cached_property
    def _modes_of_speed(self) -> tuple[ndarray, ndarray]:
        return self.model.modes_at(self.grid.speed)

    @cached_property
    def recursion(self) -> Recursion:
        """Recursion of the stepped modes, without the casing's."""
        ratios = self.scene.damping(self.frequencies, self.grid.speed)
        return recursion(self.grid.choice.integrator, self.frequencies, ratios, self.grid.time_step)

    @cached_property
    def static_modes(self) -> tuple[ndarray, ndarray]:
        """Frequencies (rad/s) and shapes of the modes that are not stepped."""
        frequencies, modes = self._modes_of_speed
        return frequencies[self._stepped :], modes[:, self._stepped :]

    @cached_property
    def stiffening(self) -> ndarray:
        """Relative change of the modes' squared frequencies per squared speed (s2), shape (modes,)."""
        if self.model.logarithmic_stiffness is not None:
            # followers keep theirs
            return self.model.logarithmic_stiffness.relative_change(self.modes, self.grid.speed)
        return np.sum(self.modes * (self.model.stiffness_per_square @ self.modes), axis=0) / self.frequencies**2


@lru_cache(maxsize=32)
def _stepped_at_rest(model: ContactModel, scene: Scene, choice: IntegrationChoice, cone_angle: float, most: int) -> int:
    """Number of the modes that are stepped, at most `most`: see stepped_modes. The same at all speeds of a sweep."""
    # of all modes at rest, and the contact nodes' displacement by them
    frequencies, rows = np.sqrt(model.squared_frequencies), casing_axes(model.displacement_operator, cone_angle)
    coefficient = scene.friction.coefficient if scene.friction else 0.0

    def is_stable(stepped: int) -> bool:
        own = frequencies[:stepped]
        stepping = recursion(choice.integrator, own, scene.damping(own, 0.0), choice.time_step)
        flexibility = residual_flexibility(frequencies[stepped:], rows[..., stepped:])[0]
        ratio = ratio_of_pressed_nodes(stepping, rows[0, :, :stepped], flexibility)
        return ratio < largest_pressed_ratio(scene)

    step, above = choice.time_step, choice.static_above
    return stepped_modes(frequencies, rows, coefficient, step, above, most, is_stable)
