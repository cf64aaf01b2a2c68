"""What the compiled engine works on, described once: a NumPy record, whose shapes are known when its program is compiled.

Only padded sizes and numbers that no speed changes are in it, so all speeds of a sweep share one compiled time integration.
"""

from __future__ import annotations

from dataclasses import fields
from functools import cache
from typing import NamedTuple

import numpy as np

from r37core.alignment import Field, aligned_record, padded
from r37core.contact.scene import Lining

from ..jump_numbers import STRIDES
from ..totals import TOTALS

NORMAL, TANGENTIAL, MERIDIONAL = range(3)
"""Directions of contact: along the casing's normal, positive towards it; growing theta; along its meridian, downstream."""

FEWEST_MODES = 32
"""Of a blade in a layout. Each layout compiles for a quarter of a minute, so a small blade takes that of a larger one."""


class Layout(NamedTuple):
    """Numbers of modes, nodes and outputs, all rounded up to whole vectors.

    `pairs`: of the modes, pairs of an elastic casing, whole vectors too; the first of each pair come after the blade's modes,
    then the second.
    """

    modes: int
    nodes: int
    outputs: int
    pairs: int


class Kind(NamedTuple):
    """What a time integration has; what it lacks is not in the program.

    `published`: the integrator is central_difference, whose forces correct the prediction; else they are those at t_n, see
    contact_steps. `vector_friction`: along the real sliding velocity; friction of constant direction
    is in the push rows and responses. `coupled`: friction is part of the complementarity problem. `exact_gap`, `energy`,
    `jumps`: see Scene and IntegrationChoice. `coriolis`: modes are complex; see r37core.time_integration.gyroscopic. `ring`:
    the casing has modes; see ring_steps. `relaxed`: see Problem.relaxation.
    """

    published: bool
    lined: bool
    vector_friction: bool
    coupled: bool
    exact_gap: bool
    energy: bool
    jumps: bool
    coriolis: bool
    ring: bool
    relaxed: bool


def layout_of(blade_modes: int, nodes: int, outputs: int, pairs: int = 0) -> Layout:
    """The layout that holds so many."""
    modes = max(padded(blade_modes), FEWEST_MODES)
    return Layout(modes + 2 * padded(pairs), padded(nodes), padded(outputs), padded(pairs))


def _numbers(names: str, kind: type = np.float64) -> list[Field]:
    return [(name, kind, ()) for name in names.split()]


def _arrays(names: str, *shape: int, kind: type = np.float64) -> list[Field]:
    return [(name, kind, shape) for name in names.split()]


LINING = aligned_record(_numbers(" ".join(field.name for field in fields(Lining)) + " area"))
"""What the law of the lining may use: every field of Lining as a number, and a bar's area (m2)."""

CASING = aligned_record(_numbers("amplitude rise period width cosine sine"))
"""Amplitude (m) of the lobes; rise rate times step; angle (rad) between lobes and their relative width; cone angle."""


def complementarity_record(nodes: int) -> np.dtype:
    """The record of a complementarity problem of `nodes` nodes, whole vectors of them; see contact.complementarity."""
    groups = padded(nodes) // padded(1)
    return aligned_record(
        [
            *_arrays("gap multiplier answer short diagonal", nodes),
            *_arrays("left", nodes + 1, nodes),
            *_arrays("matrix", nodes, nodes + 1),
            *_arrays("listed", nodes, kind=np.int64),
            *_arrays("touching wrong", groups, kind=np.int64),
        ]
    )


def contact_record(nodes: int) -> np.dtype:
    """The record of the contact problem at t_n of `nodes` nodes, whole vectors of them; see contact.node_sweeps."""
    return aligned_record(
        [
            # gaps (m) without forces and with those found, and these (N); what the last sweep changed (m)
            *_arrays("gap opened pressure change", nodes),
            # the laws of the listed nodes: own flexibility (m/N) and one over it; wear (m) of the bar; lines of
            # the bar's law in series with the node
            *_arrays("own stiffness wear elastic offset plastic", nodes),
            # opening of the last node's gap per force on the one before (m/N)
            *_arrays("columns", nodes, nodes),
            # numbers of the listed nodes; the bar of each node
            *_arrays("listed bar", nodes, kind=np.int64),
            *_arrays("found", padded(nodes) // padded(1), kind=np.int64),  # set of the listed nodes
            *_numbers("relaxation"),
        ]
    )


def _pace_fields(layout: Layout) -> list[Field]:
    modes, nodes = layout.modes, layout.nodes
    return [
        # of the recursion: see steps; energy lost per step and squared central difference; 1/keep
        *_arrays("keep pull inverse loss inverse_keep", modes),
        # increment of a free mode per displacement and per velocity, and one over the latter
        *_arrays("increment_by_displacement increment_by_velocity velocity_by_increment", modes),
        # normal displacement of the last node per force in the three directions on the one before
        *_arrays("coupling", 3, nodes, nodes),
        # opening of the last node's gap per unit multiplier of the one before: with friction, and as the problem has it
        *_arrays("response columns", nodes, nodes),
        *_arrays("clearance", nodes),  # of the round casing (m)
        # jumps over free flight: see time_integration.jump_plan
        *_arrays("jumps", STRIDES, 8, modes),
        *_arrays("amplitude_by_u amplitude_by_d", modes),
        *_arrays("slow_modes", STRIDES, kind=np.int64),
    ]


@cache
def pace_record(layout: Layout) -> np.dtype:
    """What of a time integration changes with the speed while its modes are held: the beginning of its record."""
    return aligned_record(_pace_fields(layout))


@cache
def integration_record(layout: Layout) -> np.dtype:
    """The record of a time integration: its pace, its state, its constants, room to work in, and its totals."""
    modes, nodes, outputs, pairs = layout
    groups = nodes // padded(1)
    return aligned_record(
        [
            *_pace_fields(layout),
            # displacement u_n; its increments u_n - u_{n-1} and u_{n-1} - u_{n-2}; forces on the modes
            *_arrays("u increment last_increment push", modes),
            # displacement of the nodes per mode, and what a unit normal force does to the modes, with constant friction
            *_arrays("displacement_operator", 3, nodes, modes),
            *_arrays("push_operator", nodes, modes),
            *_arrays("outputs", 1, outputs, modes),
            *_arrays("sample", outputs),
            # with Coriolis the same per increment; the size of displacement_operator per amplitude that turns; increment of the
            # last increment, had there been no force; forces on the modes' increments
            *_arrays("increment_operator size_operator", 3, nodes, modes),
            *_arrays("increment_push_operator", nodes, modes),
            *_arrays("increment_outputs", 1, outputs, modes),
            *_arrays("last_second_difference increment_push", modes),
            *_arrays("friction_share", 2, nodes),  # tangential and meridional force per normal force
            *_arrays("force", nodes),
            *_arrays("friction_force", 2, nodes),
            # of forces at t_n: normal displacement of the last node by the static modes per force on the one before; all forces
            # at a sample, and the static modes' part of it; the contact problem
            *_arrays("flexibility", 3, nodes, nodes),
            *_arrays("static_force", 3 * nodes),
            *_arrays("force_outputs", 1, outputs, 3 * nodes),
            ("contact", contact_record(nodes), ()),
            *_arrays("rotation", nodes),  # signed sliding in a step by the rotation (m)
            *_arrays("bar_position", nodes),  # angle at step 0, in bars
            *_arrays("radius theta shift", nodes),  # m; angle at step 0 and what vibration adds to it (rad)
            ("problem", complementarity_record(nodes), ()),
            *_arrays("beyond on_casing", groups, kind=np.int64),
            # by how much pairs of the casing's modes turn in a jump and, in the last row, in a step
            *_arrays("turn_cosine turn_sine", STRIDES + 1, pairs),
            # of jumps: amplitudes of the modes, and how far they bring the nodes
            *_arrays("amplitude", modes),
            *_arrays("reach", STRIDES, nodes),
            *_arrays("across towards", nodes),
            *_arrays("decay", STRIDES),
            *_arrays("lengths reach_known", STRIDES, kind=np.int64),
            ("lining", LINING, ()),
            ("casing", CASING, ()),
            ("totals", TOTALS, ()),
            *_numbers("limit friction"),
            *_numbers("number_of_outputs nodes rings steps_per_revolution steps_per_block", kind=np.int64),
            *_numbers("samples_before_snapshots samples_per_snapshot", kind=np.int64),
            # of one call: where it begins, how many blocks of steps it asks for, and the pace it is at
            *_numbers("first_step blocks pace", kind=np.int64),
            # addresses of arrays whose sizes are known only then: f(theta) at every step, and the largest of each stretch
            *_numbers("casing_shape nearest_casing wear samples snapshots", kind=np.int64),
            # all paces; pace and blocks of each stretch; motion at its ends, and largest wear by then
            *_numbers("paces places lasting ends worn", kind=np.int64),
        ]
    )
