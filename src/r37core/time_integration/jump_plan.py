"""Jumps over free flight as they are planned before a run, in NumPy: many steps of every mode as one map, and its bounds.

time_integration.compiled.jump_steps says how a run uses them.
"""

from dataclasses import dataclass

import numpy as np

from .integrators import Recursion
from .jump_numbers import COARSE, STRIDES


@dataclass(frozen=True)
class JumpPlan:
    """Jumps of `jump_lengths` steps.

    `slow_modes`, shape (strides,): modes followed along their tangent; `jumps`, shape (strides, 8, modes): the entries of the
    map less the identity (u from u, u from d, d from u, d from d), the loss as a quadratic form (uu, ud, dd), and how far a
    mode of unit amplitude gets beyond its tangent or, for fast ones, from zero; `amplitude_rows`, shape (2, modes): the
    imaginary part of a mode's complex amplitude from u and d. Of several recursions all have a first axis more.
    """

    slow_modes: np.ndarray
    jumps: np.ndarray
    amplitude_rows: np.ndarray


def plan_jumps(recursion: Recursion, steps_per_block: int, multiple: int, followed: int) -> JumpPlan | None:
    """Plan for ascending modes, of one recursion or several; None if a mode does not oscillate.

    `multiple`: slow modes are counted in these; `followed`: modes from the first on of which there may be slow ones.

    One step maps (u, d) to d' = k d - p u, u' = u + d', with k = `keep` and p = `pull` of the recursion. Its eigenvalues
    lambda are complex with |lambda|^2 = k while (1 + k - p)^2 < 4 k, so u_n = Re(C lambda^n).
    """
    keep, pull = recursion.keep, recursion.pull
    half_trace = 0.5 * (1.0 + keep - pull)
    if not np.all((keep > 0.0) & (keep <= 1.0) & (half_trace**2 < keep)):
        return None
    modulus = np.sqrt(keep)
    # lambda = modulus * (cosine + i sine); u_{n-1} = u - d = Re(C / lambda)
    cosine = half_trace / modulus
    sine = np.sqrt(1.0 - cosine**2)
    amplitude_rows = np.stack([(modulus - cosine) / sine, -modulus / sine], axis=-2)
    curvature = np.abs(1.0 - 1.0 / (modulus * (cosine + 1j * sine))) ** 2
    lengths = jump_lengths(steps_per_block)
    *several, modes = keep.shape
    jumps = np.zeros((*several, len(lengths), 8, modes))
    slow = np.zeros((*several, len(lengths)), dtype=np.int64)
    for stride, (length, jump) in enumerate(zip(lengths, _jumps(recursion, lengths), strict=True)):
        jumps[..., stride, :7, :] = np.moveaxis(jump, 0, -2)
        beyond = 0.5 * curvature * length * (length + 1)
        slow[..., stride] = np.count_nonzero(beyond[..., :followed] < 1.0, axis=-1) // multiple * multiple
        jumps[..., stride, 7, :] = np.where(np.arange(modes) < slow[..., stride, None], beyond, 1.0)
    return JumpPlan(slow, jumps, amplitude_rows)


def jump_lengths(steps_per_block: int) -> np.ndarray:
    """Steps of the jumps: what is left of a block after whole intervals, then intervals doubled while they fit."""
    lengths = [steps_per_block % COARSE]
    while len(lengths) < STRIDES and COARSE << (len(lengths) - 1) <= steps_per_block:
        lengths.append(COARSE << (len(lengths) - 1))
    return np.array(lengths, dtype=np.int64)


def _jumps(recursion: Recursion, lengths: np.ndarray) -> list[np.ndarray]:
    """Rows of the jumps up to BEYOND, each of shape (7, ..., modes); the third of `lengths` and all after it double."""
    keep, pull = recursion.keep, recursion.pull
    # of no step, of one and so on, less the identity
    single = np.stack([-pull, keep, -pull, keep - 1.0, *recursion.loss_form])
    powers = [np.zeros_like(single), single]
    while len(powers) <= lengths[:2].max():
        powers.append(_after(powers[-1], single))
    jumps = [powers[length] for length in lengths[:2]]
    while len(jumps) < len(lengths):
        jumps.append(_after(jumps[-1], jumps[-1]))
    return jumps


def _after(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """`second` done after `first`: (I + F)(I + E) = I + E + F + F E, and the loss of both."""
    a, b, c, d, q, r, s = first
    e, f, g, h, t, v, w = second
    i, j = 1.0 + a, 1.0 + d
    return np.stack(
        [
            a + e + e * a + f * c,
            b + f + e * b + f * d,
            c + g + g * a + h * c,
            d + h + g * b + h * d,
            q + t * i**2 + v * i * c + w * c**2,
            r + 2.0 * t * i * b + v * (i * j + b * c) + 2.0 * w * c * j,
            s + t * b**2 + v * b * j + w * j**2,
        ]
    )


def nearest_casing(shape: np.ndarray, steps_per_block: int) -> np.ndarray:
    """Largest f(theta) in the COARSE steps that follow each place a jump may begin at.

    `shape`, shape (steps per revolution, nodes), f at each step. Returns shape (blocks per revolution, ceil(steps per block /
    COARSE), nodes).
    """
    nodes = shape.shape[1]
    following = np.roll(shape, -1, axis=0).reshape(-1, steps_per_block, nodes)
    return np.maximum.reduceat(following, np.arange(0, steps_per_block, COARSE), axis=1)
