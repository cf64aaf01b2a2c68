"""State of a run, which an engine changes, and the record that a part of it leaves behind."""

from dataclasses import dataclass, field

import numpy as np
from numpy import ndarray
from numpy.typing import ArrayLike

TOTALS = np.dtype(
    [
        ("steps_in_contact", np.float64),  # steps with any contact force
        ("casing_hits", np.float64),  # onsets of direct contact
        ("largest_force", np.float64),  # normal, on a node (N)
        ("worst_complementarity", np.float64),  # largest relative violation
        ("work", np.float64),  # of the contact forces (J)
        ("loss", np.float64),  # of energy to damping (J)
        ("friction_heat", np.float64),  # work of the friction against the sliding over the casing (J)
        ("steps", np.float64),
        ("steps_bounded", np.float64),  # in which the elastic energy of second order was bounded
        ("largest_penetration", np.float64),  # of the tip's edge into the casing (m), in steps with a contact force
    ]
)
"""Totals that are added up over a run."""


@dataclass
class SimulationState:
    """State of a run; a run may be stopped after any of its `samples` and go on from its state.

    `displacement` u_n and `increment` u_n - u_{n-1}, shape (modes,), in the speed's modes; `wear` (m), shape (rings, bars), of
    no bars on a bare casing;
    `touched`, shape (nodes,): whether a node touched the casing in the last step; `contact_force` (N), shape (3, nodes): what
    presses the nodes at t_n with exact_modal, along normal, tangent and meridian; in a lining `penetration` (m) of the nodes
    beyond its unworn surface at t_n, negative where they are clear, and `bar_position`, their angle in bars, shape (nodes,)
    (which the compiled engine needs with the exact gap alone); `totals`: see TOTALS. `marks`: samples of the run and totals up
    to there, every MARKED revolutions and where a part of the run ends.
    """

    displacement: ndarray
    increment: ndarray
    wear: ndarray
    touched: ndarray
    contact_force: ndarray
    penetration: ndarray
    bar_position: ndarray
    samples: int = 0
    totals: ndarray = field(default_factory=lambda: np.zeros((), TOTALS))
    marks: list[tuple[int, ndarray]] = field(default_factory=list)


class Schedule:
    """Constant-speed segments one after another: what an engine is to do, and what it leaves of each.

    `speed_indices`, `samples`, shape (segments,): the speed of each segment and its length. Filled by the engine:
    `ends`, shape (segments, 2, 2, modes), displacement and increment as a segment begins and as it ends; `wear` (m), shape
    (segments,), the largest by its end.
    """

    def __init__(self, speed_indices: ArrayLike, samples: ArrayLike, modes: int):
        self.speed_indices, self.samples = (np.ascontiguousarray(part, dtype=np.int64) for part in (speed_indices, samples))
        segments = len(self.samples)
        self.ends, self.wear = np.empty((segments, 2, 2, modes)), np.zeros(segments)


@dataclass(frozen=True)
class SimulationRecord:
    """Record of some revolutions.

    `samples` (m), shape (samples, 6): normal, radial and tangential displacement of the leading edge, then of the trailing
    edge; `snapshots`, shape (snapshots, numbers): see ContactOperators; `diverged`; `casing` (m), shape (samples, casing
    modes), of an elastic casing: see ContactOperators. What an engine fills has them among the samples.
    """

    samples: ndarray
    snapshots: ndarray
    diverged: bool = False
    casing: ndarray | None = None
