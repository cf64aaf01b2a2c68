"""Layout of the numbers that the compiled engine works on: a NumPy record, whose shapes are known when its program is compiled.

Only padded sizes and numbers that no speed changes are in it, so all speeds of a sweep share one compiled time integration.
"""

from dataclasses import fields
from functools import cache
from typing import NamedTuple

import numpy as np

from r37core.contact.scene import Lining
from r37core.machine_code.alignment import LANES, Field, aligned_record, padded
from r37core.rom.quadratic_terms import MOST_QUADRATIC_MODES, mode_pairs

from ..state import TOTALS


class Kind(NamedTuple):
    """Kind of a program: constants of its functions, so that what a scene lacks is not in its program.

    What costs a run hardly anything where it is absent is a flag of the record instead: one program more takes longer to make
    than it saves. `published`: the integrator is central_difference, whose forces correct the prediction; else they are those
    at t_n, see contact_steps. `exact_gap`: see Scene.
    """

    published: bool
    exact_gap: bool

    @property
    def constants(self) -> dict[str, bool]:
        """Constants by the names that the functions use."""
        return {name.upper(): value for name, value in self._asdict().items()}


PUBLISHED = EXACT_GAP = False
"""Placeholders of a kind's constants: each program has its own (r37core.machine_code.program_constants)."""

NORMAL, TANGENTIAL, MERIDIONAL = range(3)
"""Directions of contact: along the casing's normal, positive towards it; growing theta; along its meridian, downstream."""

FEWEST_MODES, FEWEST_NODES = 96, 8
"""Smallest capacity. A program takes seconds to make, and a step costs what is used of its record, not its room."""

MOST_PRODUCTS = len(mode_pairs(MOST_QUADRATIC_MODES)[0])
"""Largest number of products of second order."""

MOST_FUNCTIONALS = padded(MOST_QUADRATIC_MODES + MOST_PRODUCTS)
"""Room for the rows of r37core.time_integration.quadratic_motion."""


class Capacity(NamedTuple):
    """Room for modes and nodes, in whole vectors: a program is compiled for it and for its kind.

    Most blades step 32 or 40 modes, with central differences up to 93. A vector of nodes is handled without loops, so more
    nodes are another capacity. Both are doubled. The modes of an elastic casing count, by pairs: the first of each pair come
    after the blade's modes, then the second, each whole vectors. Products of second order count, too, behind the blade's modes.
    Outputs are never more than modes.
    """

    modes: int
    nodes: int


def capacity_of(modes: int, nodes: int) -> Capacity:
    """Smallest capacity that has room for so many modes and nodes."""
    most_modes, most_nodes = FEWEST_MODES, FEWEST_NODES
    while most_modes < modes:
        most_modes *= 2
    while most_nodes < nodes:
        most_nodes *= 2
    return Capacity(most_modes, most_nodes)


def _fields(names: str, *shape: int, kind: type | np.dtype = np.float64) -> list[Field]:
    return [(name, kind, shape) for name in names.split()]


LINING = aligned_record(_fields(" ".join(field.name for field in fields(Lining))))
"""Numbers of the lining's law: every field of Lining as a number."""

CASING = aligned_record(_fields("amplitude rise period width cosine sine"))
"""Amplitude (m) of the lobes; rise rate times step; angle (rad) between lobes and their relative width; cone angle."""


def contact_record(nodes: int) -> np.dtype:
    """The record of the contact problem of `nodes` nodes, whole vectors of them; see contact.node_forces."""
    return aligned_record(
        # gaps (m) without forces and with those found, and these (N)
        _fields("gap opened pressure", nodes),
        # the laws of the listed nodes: own flexibility (m/N) and one over it; pressed area (m2) and wear (m) of the bar;
        # lines of the bar's law in series with the node
        _fields("own stiffness area wear elastic offset plastic", nodes),
        # the line that each law is on, its slope (N/m) and its force (N) where no node is pressed; what is left of the linear
        # problem, and one over its pivots
        _fields("slope intercept inverse", nodes),
        _fields("left", nodes + 1, nodes),
        # opening of the last node's gap per force on the one before (m/N)
        _fields("columns", nodes, nodes),
        # numbers of the listed nodes, and of those on a line with a slope or, in the end, with a force; the bar of each node
        _fields("listed pressed bar", nodes, kind=np.int64),
        _fields("found", padded(nodes) // padded(1), kind=np.int64),  # set of the listed nodes
        _fields("lanes", kind=np.int64),  # that the nodes fill
    )


@cache
def constants_record(modes: int, nodes: int) -> np.dtype:
    """Record of what changes with the speed while its modes are held, of whole vectors of modes and nodes."""
    return aligned_record(
        # of the recursion: see steps; energy lost per step and squared central difference
        _fields("keep pull inverse loss", modes),
        # increment of a free mode per displacement and per velocity, and one over the latter
        _fields("increment_by_displacement increment_by_velocity velocity_by_increment", modes),
        # normal displacement of the last node per force in the three directions on the one before
        _fields("coupling", 3, nodes, nodes),
        _fields("clearance", nodes),  # of the round casing (m)
    )


def second_order_record(modes: int) -> np.dtype:
    """Record of displacements of second order, of whole vectors of modes: see time_integration.quadratic_motion."""
    return aligned_record(
        # the amplitudes of the lowest modes and, behind them, what stiffens each product, at t_n and t_{n-1}; what pulls at
        # each; their rows
        _fields("functional last pull", MOST_FUNCTIONALS),
        _fields("push", MOST_QUADRATIC_MODES),  # on the lowest modes by that on the products
        _fields("stepped", modes),  # 1, and 0 for products
        _fields("rows", 1, MOST_FUNCTIONALS, modes),
        # b/6, by which the first product stiffens the last, and what all products stiffen each
        _fields("cubic", MOST_PRODUCTS, padded(MOST_PRODUCTS)),
        _fields("stiffened", padded(MOST_PRODUCTS)),
        # how often each product counts, and the stiffness that Q gives it; the part of b/6 that is of Q; its two modes
        _fields("weight pull_left", MOST_PRODUCTS),
        _fields("left", MOST_PRODUCTS, MOST_PRODUCTS),
        _fields("first second", MOST_PRODUCTS, kind=np.int64),
        _fields("product_of", MOST_QUADRATIC_MODES, MOST_QUADRATIC_MODES, kind=np.int64),  # of two modes
        # B, and the sum of the squared products up to which it is surely not passed
        _fields("bound surely_within"),
        # functionals, whole vectors of them, products, and the lane of the first product
        _fields("functionals lanes products lane", kind=np.int64),
    )


EDGE = aligned_record(
    _fields("position shape meridional", LANES),  # of eight nodes
    # groups of eight nodes: the few, and these with all of them
    _fields("few groups", kind=np.int64),
    # distance of a contact node to the casing behind a lining below which the edge is looked at
    _fields("near"),
    # addresses: displacement per mode, shape (directions, groups, modes, 8), and per force, (groups, 3 contact nodes, 8);
    # clearance, radius and angle of the nodes; the casing's shape at two turns of steps, the step of each node's angle, and
    # the shares of the four values round it
    _fields("rows flexibility clearance radius theta table steps shares", kind=np.int64),
)
"""The tip's edge: see edge_steps. Without groups it is not looked at."""

CALL = aligned_record(
    # where it begins, how many blocks of steps it asks for, and the speed it is at; blocks that were done and snapshots kept
    _fields("first_step blocks speed_index done kept", kind=np.int64),
    # how many steps the time is ahead of their number
    _fields("ahead"),
    # addresses of arrays whose sizes are known only then: f(theta) at every step
    _fields("casing_shape wear samples snapshots", kind=np.int64),
    # constants of all speeds; speed and blocks of each segment; motion at its ends, and largest wear by then
    _fields("constants speed_indices lasting ends worn", kind=np.int64),
    # what each block adds to the clearance (m)
    _fields("openings", kind=np.int64),
    # count of a speed's constants
    _fields("constants_size", kind=np.int64),
)
"""Arguments of a call of the program."""


@cache
def integration_record(capacity: Capacity) -> np.dtype:
    """The record of a time integration: constants of its speed, state, operators, room to work in, and totals."""
    modes, nodes = capacity
    groups = nodes // padded(1)
    return aligned_record(
        _fields("speed", kind=constants_record(modes, nodes)),
        # displacement u_n; its increments u_n - u_{n-1} and u_{n-1} - u_{n-2}
        _fields("u increment last_increment", modes),
        _fields("push", modes),  # forces on the modes
        # displacement of the nodes per mode, and the size of it per amplitude that turns
        _fields("displacement_operator", 3, nodes, modes),
        _fields("outputs", 1, modes, modes),
        _fields("sample", modes),
        _fields("friction_share", 2, nodes),  # tangential and meridional force per normal force
        _fields("force", nodes),
        _fields("friction_force", 2, nodes),
        # of forces at t_n: normal displacement of the last node by the static modes per force on the one before; all forces
        # at a sample, and the static modes' part of it; the contact problem
        _fields("flexibility", 3, nodes, nodes),
        _fields("static_force", 3 * nodes),
        _fields("force_outputs", 1, modes, 3 * nodes),
        _fields("contact", kind=contact_record(nodes)),
        _fields("second", kind=second_order_record(modes)),
        # sliding in a step (m): signed, by the rotation; length that friction acts along
        _fields("sliding", 2, nodes),
        # angle at step 0, in bars; surface (m2) of the casing under a bar; penetration (m) and, with the
        # exact gap, angle in bars at t_n
        _fields("bar_position bar_surface penetration last_position", nodes),
        _fields("radius theta shift", nodes),  # m; angle at step 0 and what vibration adds to it (rad)
        _fields("touched", groups, kind=np.int64),
        # by how much pairs of the casing's modes turn in a step
        _fields("turn_cosine turn_sine", modes // 2),
        _fields("lining", kind=LINING),
        _fields("casing", kind=CASING),
        _fields("edge", kind=EDGE),
        _fields("totals", kind=TOTALS),
        # of a blade beside others: work, doubled, and energy lost in a block, and whether there are forces at t_n
        _fields("block_energy", 2, LANES),
        _fields("follows", kind=np.int64),
        _fields("worn largest_wear"),  # off the lining by this blade (m3); of all bars (m)
        _fields("limit friction opening"),  # of the clearance in this block (m)
        # how much of the record is used: lanes of modes; numbers
        _fields("mode_lanes pairs number_of_outputs nodes", kind=np.int64),
        _fields("follows_sliding", kind=np.int64),  # whether the direction of friction follows the sliding
        # whether there is a lining; whether displacements are of second order, see time_integration.quadratic_motion
        _fields("lined quadratic", kind=np.int64),
        _fields("steps_per_revolution steps_per_block samples_before_snapshots samples_per_snapshot", kind=np.int64),
        _fields("call", kind=CALL),
    )
