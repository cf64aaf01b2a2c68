"""The two ways of stepping a mode in time: central differences, and its motion between contacts in closed form."""

from __future__ import annotations

from dataclasses import astuple, dataclass

import numpy as np
from numpy import ndarray

CENTRAL_DIFFERENCE, EXACT_MODAL = INTEGRATORS = ("central_difference", "exact_modal")

Numbers = float | ndarray


@dataclass(frozen=True)
class Recursion:
    """u_{n+1} = a u_n + b u_{n-1} + c F of unit-mass modes under modal forces F; arrays of shape (modes,).

    Of several recursions they have shape (recursions, modes).
    `keep` -b, `pull` 1 - a - b and `inverse` c: carried in displacement and increment d_n = u_n - u_{n-1} it reads
    d_{n+1} = keep d_n - pull u_n + inverse F, which keeps the digits that a + b = 1 - pull loses. `lost` = 1 - keep.

    Multiplied with (u_{n+1} - u_{n-1})/(2c) it is a balance of energies, whatever a, b and c are:
    E_{n+1} - E_n = F (u_{n+1} - u_{n-1})/2 - (1 - keep)/(4c) (u_{n+1} - u_{n-1})^2 with
    E_n = ((1 + keep)/2 d_n^2 + pull u_n u_{n-1})/(2c), kinetic plus elastic energy up to the order of the step.
    """

    keep: ndarray
    pull: ndarray
    inverse: ndarray
    lost: ndarray

    def __getitem__(self, row: int | slice | ndarray | None) -> Recursion:
        """Select one or some of several recursions, whose arrays have shape (recursions, modes), or some modes of one.

        None: one as several.
        """
        return type(self)(self.keep[row], self.pull[row], self.inverse[row], self.lost[row])

    @property
    def loss(self) -> ndarray:
        """Energy lost to damping per step and squared u_{n+1} - u_{n-1}, shape (modes,)."""
        return self.lost / (4.0 * self.inverse)

    def energy(self, displacement: ndarray, increment: ndarray) -> ndarray:
        """Energy E_n (J) of u_n and d_n, in the shape of the recursion; conserved by the free undamped one."""
        kinetic = 0.5 * (1.0 + self.keep) * increment**2
        return np.sum((kinetic + self.pull * displacement * (displacement - increment)) / (2.0 * self.inverse), axis=-1)


def joined(first: Recursion, second: Recursion) -> Recursion:
    """The recursion of the modes of both."""
    parts = zip(astuple(first), astuple(second), strict=True)
    return Recursion(*(np.concatenate(part, axis=-1) for part in parts))


def central_difference(frequencies: ndarray, damping_ratio: Numbers, step: Numbers) -> Recursion:
    """Central differences for modes of angular `frequencies` (rad/s), stable for steps (s) below 2/frequency.

    c = (1/h^2 + xi omega/h)^-1, b = c (xi omega/h - 1/h^2), a = c (2/h^2 - omega^2) = 1 - b - c omega^2: section 5 of the
    benchmark with D = 2 xi omega. Energy: Belytschko, Liu, Moran, Nonlinear Finite Elements, section 6.2.
    """
    inverse = 1.0 / (1.0 / step**2 + damping_ratio * frequencies / step)
    return Recursion(
        keep=inverse * (1.0 / step**2 - damping_ratio * frequencies / step),
        pull=inverse * frequencies**2,
        inverse=inverse,
        lost=2.0 * inverse * damping_ratio * frequencies / step,
    )


def exact_modal(frequencies: ndarray, damping_ratio: Numbers, step: Numbers) -> Recursion:
    """The free motion of underdamped modes (damping ratio below 1) without error, for any step (s).

    u(t) = e^(-xi omega t) (A cos omega_d t + B sin omega_d t) satisfies u_{n+1} = a u_n + b u_{n-1} with
    a = 2 e^(-xi omega h) cos(omega_d h), b = -e^(-2 xi omega h), omega_d = omega sqrt(1 - xi^2): sum and product of the two
    values of e^(lambda h), lambda the roots of lambda^2 + 2 xi omega lambda + omega^2 (Meirovitch, Fundamentals of Vibrations,
    section 2.2). A force enters with c = (1 - a - b)/omega^2, so that under a constant one the mode rests at F/omega^2.
    """
    decay = damping_ratio * frequencies * step
    half_angle = 0.5 * frequencies * np.sqrt(1.0 - damping_ratio**2) * step
    # 1 - a - b = (1 - e^-decay)^2 + 2 e^-decay (1 - cos), without the cancellation of small steps
    pull = np.expm1(-decay) ** 2 + 4.0 * np.exp(-decay) * np.sin(half_angle) ** 2
    return Recursion(keep=np.exp(-2.0 * decay), pull=pull, inverse=pull / frequencies**2, lost=-np.expm1(-2.0 * decay))


def recursion(integrator: str, frequencies: ndarray, damping_ratio: Numbers, step: Numbers) -> Recursion:
    """The recursion of one of INTEGRATORS; of several with steps of shape (recursions, 1)."""
    stepping = {CENTRAL_DIFFERENCE: central_difference, EXACT_MODAL: exact_modal}
    return stepping[integrator](frequencies, damping_ratio, step)


@dataclass(frozen=True)
class Increments:
    """Increment u_n - u_{n-1} of free modes per displacement u_n and per velocity at t_n, in the shape of a recursion."""

    displacement_factor: ndarray
    velocity_factor: ndarray

    def increment(self, row: int, displacement: ndarray, velocity: ndarray) -> ndarray:
        """Increment of the modes of one of several recursions."""
        return self.displacement_factor[row] * displacement + self.velocity_factor[row] * velocity

    def velocity(self, row: int, displacement: ndarray, increment: ndarray) -> ndarray:
        """Velocity of the modes of one of several recursions."""
        return (increment - self.displacement_factor[row] * displacement) / self.velocity_factor[row]


def increments(integrator: str, frequencies: ndarray, damping_ratio: Numbers, step: Numbers) -> Increments:
    """Increments of the modes of a recursion.

    With exact_modal the closed form taken a step back; with central differences from v_n = (u_{n+1} - u_{n-1})/(2h) and the
    recursion. Of modes that turn by less than half a turn in a step.
    """
    if integrator == CENTRAL_DIFFERENCE:
        stepping = central_difference(frequencies, damping_ratio, step)
        return Increments(stepping.pull / (1.0 + stepping.keep), 2.0 * step / (1.0 + stepping.keep))
    decay, damped = damping_ratio * frequencies * step, frequencies * np.sqrt(1.0 - damping_ratio**2)
    grown, sine = np.exp(decay), np.sin(damped * step)
    # 1 - e^decay (cos - xi omega/omega_d sin), without the cancellation of small steps
    backwards = 2.0 * np.sin(0.5 * damped * step) ** 2 - np.expm1(decay) * np.cos(damped * step)
    backwards += grown * sine * damping_ratio * frequencies / damped
    return Increments(backwards, grown * sine / damped)
