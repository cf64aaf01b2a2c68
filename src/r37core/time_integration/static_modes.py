"""Choice of the modes that follow the contact forces statically: too fast for the step, and so many that forces are unique.

The contact forces at an instant follow from the residual flexibility R of the static modes alone. With friction a normal force
on node k opens the gap of node i by G_ik = -R_ik d_k, d_k being the directions of its force. If the symmetric part of G is
positive definite, every principal minor of G is positive, and forces and gaps are unique (Cottle, Pang and Stone, The Linear
Complementarity Problem, theorems 3.1.6 and 3.3.7). Strong friction makes it indefinite (Painleve's paradox: Genot and
Brogliato, Eur. J. Mech. A 18 (1999) 653-677); so do static modes that are too few to move every contact node by itself.
"""

from collections.abc import Callable

import numpy as np
from numpy import ndarray

from r37core.machine_code.alignment import LANES, padded

from .step_limit import UnstableStepError

SETTLES_SOON = 0.2
"""Definiteness of G with which nodes settle soon, even one after the other: taken wherever some choice of modes has it."""

SMALLEST_DEFINITENESS = 0.05
"""Smallest definiteness of G otherwise, so that forces settle."""

SHARE_WITH_FRICTION = 0.2
"""Share of the definiteness without friction that friction has to leave. It is 0.9 of nodes of the mesh, and 0.1 to 0.4 of
patches, whose neighbours static modes move together: the closer they are, the less."""

_ANGLES = np.linspace(0.0, 2.0 * np.pi, 16, endpoint=False)
"""Directions of friction that are tried (rad)."""

_LARGEST_TURN = 2.0
"""Largest turn of a stepped mode in a step (rad), relative to static_above."""


class TooFewStaticModesError(ValueError):
    """A model whose contact forces are not unique, whichever modes are static."""


def residual_flexibility(frequencies: ndarray, rows: ndarray) -> ndarray:
    """Normal displacement (m/N) of the last node per force on the first, along each direction, by static modes.

    Sum of phi phi^T/omega^2 over the modes of `frequencies` (rad/s) (Craig and Kurdila, Fundamentals of Structural Dynamics,
    section 17.4); `rows`, shape (3, nodes, modes): displacement of the nodes. Returns shape (3, nodes, nodes).
    """
    static = rows / frequencies
    return static @ static[0].T


def definiteness(flexibility: ndarray, coefficient: float) -> float:
    """Smallest eigenvalue of the symmetric part of G, scaled to a unit normal flexibility of each node.

    The least over directions of friction that all nodes share. `flexibility` as of residual_flexibility; `coefficient` of
    friction. Not positive where the normal flexibility of a node is zero.
    """
    own = np.diag(flexibility[0])
    if not np.all(own > 0.0):
        return 0.0
    opening = _opening(flexibility, coefficient) / np.sqrt(np.outer(own, own))
    return float(np.linalg.eigvalsh(0.5 * (opening + opening.swapaxes(1, 2)))[:, 0].min())


def _opening(flexibility: ndarray, coefficient: float) -> ndarray:
    """Opening of the last node's gap per normal force on the one before, for each of _ANGLES."""
    normal, tangential, meridional = flexibility
    cosine, sine = (coefficient * function(_ANGLES)[:, None, None] for function in (np.cos, np.sin))
    return normal - cosine * tangential - sine * meridional


def stepped_modes(
    frequencies: ndarray,
    rows: ndarray,
    coefficient: float,
    step: float,
    static_above: float,
    most: int,
    is_stable: Callable[[int], bool] = lambda stepped: True,
) -> int:
    """Number of the modes that are stepped, in whole vectors where there are more than one, which cost no more.

    Those that turn by less than `static_above` in a `step` (s), at most `most` of them, as far as the others make the contact
    forces unique at a `coefficient` of friction, and pressed nodes are stable with them (`is_stable`, where that can be): else
    some more, or fewer. `frequencies` (rad/s) at rest, ascending, and
    `rows`, shape (3, nodes, modes), of all modes. Raises UnstableStepError and TooFewStaticModesError.
    """
    modes = len(frequencies)

    def static_flexibility(stepped: int) -> ndarray:
        return residual_flexibility(frequencies[stepped:], rows[..., stepped:])

    def settles_soon(stepped: int) -> bool:
        return definiteness(static_flexibility(stepped), coefficient) > SETTLES_SOON

    def is_unique(stepped: int, friction: float = coefficient) -> bool:
        flexibility = static_flexibility(stepped)
        least = max(SMALLEST_DEFINITENESS, SHARE_WITH_FRICTION * definiteness(flexibility, 0.0))
        return definiteness(flexibility, friction) > least

    turns = frequencies * step / static_above
    slow, largest_count = (int(np.count_nonzero(turns <= largest)) for largest in (1.0, _LARGEST_TURN))
    # at least one: a blade of static modes alone would not vibrate
    wanted = max(min(padded(slow), largest_count, most), 1)
    counts = sorted({wanted, *range(1, LANES), *range(LANES, modes, LANES)})
    more = [count for count in counts if wanted <= count <= max(largest_count, 1)]
    fewer = [count for count in reversed(counts) if count < wanted]
    too_fast = [count for count in counts if count > max(largest_count, 1)]
    unstable = None
    for is_enough in (settles_soon, is_unique):
        for stepped in filter(is_enough, (*more, *fewer)):
            if is_stable(stepped):
                return stepped
            unstable = unstable or stepped
    if unstable is not None:
        # the step is refused or shortened
        return unstable
    for stepped in filter(is_unique, too_fast):
        fastest = float(frequencies[stepped - 1])
        limit = _LARGEST_TURN * static_above / fastest
        raise UnstableStepError(
            f"time_step_s: {step:.6g} s, not below {limit:.6g} s: for unique contact forces with a coefficient of friction of "
            f"{coefficient:g} modes up to {fastest / 2e3 / np.pi:.1f} kHz must be stepped; use a smaller one",
            limit,
            limit * (1.0 - 1e-9),
        )
    raise TooFewStaticModesError(_remedy(counts, is_unique, coefficient, modes, rows.shape[1]))


def _remedy(counts: list[int], is_unique: Callable[[int, float], bool], coefficient: float, modes: int, nodes: int) -> str:
    bears, fails = 0.0, coefficient
    if not any(is_unique(count, bears) for count in counts):
        return (
            f"the reduced model has {modes} modes for {nodes} contact nodes, too few for unique contact forces; allowed: fewer "
            "contact nodes (structure.boundary.nodes), more modes, or the integrator central_difference"
        )
    for _ in range(10):
        middle = 0.5 * (bears + fails)
        bears, fails = (middle, fails) if any(is_unique(count, middle) for count in counts) else (bears, middle)
    return (
        f"friction.coefficient of the scene (scenes.yaml): found {coefficient:g}, at which this blade's contact forces are not "
        f"unique (Painleve's paradox); allowed: up to about {0.995 * bears:.3g}, or the integrator central_difference"
    )
