"""Modes that the Coriolis force couples: complex shapes, each with one complex amplitude that is followed without error.

In a speed's own modes, of angular frequencies W, the blade follows q'' + g q' + W^2 q = f with g skew-symmetric. With
y = (W q, q') that is y' = A y + (0, f), A real and skew-symmetric: -i A is Hermitian, its eigenvalues +-w_j are real and its
eigenvectors orthonormal (Meirovitch, J. Appl. Mech. 42 (1975) 446-450). So

    q = Re sum_j s_j zeta_j,    zeta_j' = i w_j zeta_j - (i/w_j) s_j^H f,    energy = sum_j w_j^2 |zeta_j|^2/2.

Damping makes i w_j the root of lambda^2 + 2 xi w_j lambda + w_j^2, as of every real mode without the coupling.
"""

from dataclasses import dataclass

import numpy as np

from .integrators import Numbers, Recursion

LARGEST_TURN = 2.0
"""Largest turn of a mode in a step (rad) with which the Coriolis force acts on it. Faster ones, which a large
static_above leaves, keep their real shapes: towards half a turn in a step two real numbers no longer determine a complex
amplitude. The coupling, of up to 2 Omega, adds to a turn less than 4 pi by the steps of a revolution."""


@dataclass(frozen=True)
class ComplexModes:
    """Angular `frequencies` w_j (rad/s), shape (modes,), and complex `shapes` s_j, shape (real modes, modes).

    The sum of Re s_j s_j^H is the identity, and that of Re s_j s_j^H/w_j^2 the flexibility, which the coupling leaves alone.
    """

    frequencies: np.ndarray
    shapes: np.ndarray

    def real_shapes(self, recursion: Recursion) -> tuple[np.ndarray, np.ndarray]:
        """Displacement of the real modes per u_j and per d_j, where u_n = Re zeta and d_n = u_n - u_{n-1} of free motion."""
        u_factor, d_factor = imaginary_part(recursion)
        turned = self.shapes.imag
        # none where the shape is real, however fast the mode
        u_factor, d_factor = (np.where(turned.any(axis=0), values, 0.0) for values in (u_factor, d_factor))
        return self.shapes.real - turned * u_factor, -turned * d_factor

    def begun(
        self, frequencies: np.ndarray, displacement: np.ndarray, velocity: np.ndarray, damping_ratio: Numbers, step: float
    ) -> tuple[np.ndarray, np.ndarray]:
        """u and d of the free motion that has `displacement` and `velocity` of the real modes, shape (real modes,).

        The amplitudes for which Re sum s_j zeta_j and Re sum lambda_j s_j zeta_j are these, with the damping in lambda_j.
        `frequencies` (rad/s): of the real modes; `damping_ratio`: of the complex ones; `step` (s).
        """
        turn = -damping_ratio + 1j * np.sqrt(1.0 - damping_ratio**2)
        # in w_j zeta_j, and with the rows of the displacement times W, all numbers are about one
        rows = np.concatenate([frequencies[:, None] * self.shapes / self.frequencies, turn * self.shapes])
        motion = np.concatenate([frequencies * displacement, velocity])
        parts = np.linalg.solve(np.hstack([rows.real, -rows.imag]), motion).reshape(2, -1) / self.frequencies
        amplitude = parts[0] + 1j * parts[1]
        return amplitude.real, -(amplitude * np.expm1(-turn * self.frequencies * step)).real


def complex_modes(frequencies: np.ndarray, coupling: np.ndarray) -> ComplexModes:
    """Modes of q'' + g q' + diag(frequencies^2) q = 0, with a skew-symmetric `coupling` g (rad/s), shape (modes, modes).

    A shape's largest number is real and positive, so that modes without coupling keep their real shapes.
    """
    coupled_frequencies, shapes = frequencies.copy(), np.eye(len(frequencies), dtype=complex)
    coupled = np.flatnonzero(coupling.any(axis=0))
    if len(coupled):
        stiff, modes = np.diag(frequencies[coupled]), len(coupled)
        block = coupling[np.ix_(coupled, coupled)]
        values, vectors = np.linalg.eigh(-1j * np.block([[np.zeros_like(stiff), stiff], [-stiff, -block]]))
        coupled_frequencies[coupled] = values[modes:]
        moving = np.sqrt(2.0) * coupled_frequencies[coupled] * vectors[:modes, modes:] / frequencies[coupled, None]
        largest = moving[np.abs(moving).argmax(axis=0), np.arange(modes)]
        shapes[np.ix_(coupled, coupled)] = moving * (np.abs(largest) / largest)
    return ComplexModes(coupled_frequencies, shapes)


def imaginary_part(recursion: Recursion) -> np.ndarray:
    """Im zeta_n per u_n = Re zeta_n and per d_n = Re(zeta_n - zeta_n/Lambda), shape (2, modes).

    Lambda = rho (cos + i sin) is the root of Lambda^2 - (1 + keep - pull) Lambda + keep.
    """
    modulus = np.sqrt(recursion.keep)
    # without the cancellation of small steps: rho sin = sqrt(keep - ((1 + keep - pull)/2)^2)
    shrunk = recursion.lost / (1.0 + modulus)
    turned = 0.5 * np.sqrt((recursion.pull - shrunk**2) * ((1.0 + modulus) ** 2 - recursion.pull))
    return np.array([0.5 * (recursion.pull - recursion.lost), -recursion.keep]) / turned


@dataclass(frozen=True)
class ComplexRecursion(Recursion):
    """The recursion of u_n = Re zeta_n of complex modes, whose energy and loss do not depend on their phase.

    A force is a kick at t_n between two flights. With a = N_u^T F and b = N_d^T F, N_u and N_d the displacement per u and d,
    it adds -(c/keep) b to u_n and (c/keep) a to d_n: -i c/Im(Lambda) s^H F to zeta_n. One flight on that is c (a + pull b/keep)
    to d_{n+1}, and as much less c b/keep to u_{n+1}. Without coupling b is zero and this is the recursion of a real mode.
    Undamped modes rest under a constant force, mid-kick, where the stiffness says. Filtered kicks between exact flights:
    Hairer, Lubich and Wang, Numer. Math. 144 (2020) 787-809, of charged particles in a magnetic field.

    E_n = keep/(2c) (pull u_n (u_n - d_n) + ((1 - keep) u_n + keep d_n) d_n) is cos^2(w h/2) w^2 |zeta_n|^2/2 without damping.
    A flight loses (1 - keep) E_n. A kick adds F times the central difference of the displacement on the free motion
    through the mid-kick state: N_u (keep d + q u) - N_d (q d + pull u), q = (1 - keep - pull)/2.
    """

    @property
    def loss(self) -> np.ndarray:
        """Energy lost to damping per step and number of `loss_form`, shape (modes,)."""
        return self.lost * self.keep / (2.0 * self.inverse)

    @property
    def loss_form(self) -> list[np.ndarray]:
        """The loss of a free step as a quadratic form of u and d before it: uu, ud, dd."""
        return [self.loss * self.pull, self.loss * (self.lost - self.pull), self.loss * self.keep]

    def energy(self, displacement: np.ndarray, increment: np.ndarray) -> np.ndarray:
        """Energy E_n (J) of u_n and d_n, in the shape of the recursion."""
        kinetic = (self.lost * displacement + self.keep * increment) * increment
        elastic = self.pull * displacement * (displacement - increment)
        return np.sum((kinetic + elastic) * self.keep / (2.0 * self.inverse), axis=-1)
