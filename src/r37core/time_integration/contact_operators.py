"""Linear operators of a run: from the motion of all modes to its contact nodes, samples and snapshots, and from forces back."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy import ndarray

from r37core.contact.casing import casing_axes

from .casing_of_run import CasingOfRun
from .integrators import Recursion, joined, recursion
from .quadratic_motion import QuadraticMotion
from .stepped_blade import SteppedBlade


@dataclass(frozen=True, eq=False)
class ContactOperators:
    """Operators of a stepped `blade` and its `casing`.

    The modes of an elastic casing follow those of the blade wherever "all modes" are meant: the recursion, the operators, a
    snapshot.
    """

    blade: SteppedBlade
    casing: CasingOfRun

    @property
    def highest_frequency(self) -> float:
        """Highest frequency of all modes that are stepped (rad/s), the casing's among them."""
        ring_part = self.casing.ring.frequencies.max() if self.casing.ring is not None else 0.0
        return float(max(self.blade.frequencies.max(), ring_part))

    @cached_property
    def recursion(self) -> Recursion:
        """Recursion of all modes, the casing's without turning."""
        own, ring, grid = self.blade.recursion, self.casing.ring, self.blade.grid
        if ring is None:
            return own
        return joined(own, recursion(grid.choice.integrator, ring.frequencies, ring.damping_ratios, grid.time_step))

    @cached_property
    def _shapes(self) -> ndarray:
        """Displacement in the modes at rest per displacement of all modes. The casing's move no mode of the blade."""
        return np.hstack([self.blade.modes, np.zeros((len(self.blade.modes), len(self._ring_rows[0, 0])))])

    @cached_property
    def _ring_rows(self) -> ndarray:
        """Columns of the casing's modes in `displacement_operator`, with which the nodes come nearer to it."""
        if self.casing.ring is None:
            return np.empty((3, len(self.casing.tip.radius), 0))
        return -casing_axes(self.casing.ring.displacement(self.casing.tip.theta), self.casing.cone_angle)

    @cached_property
    def operator_at_rest(self) -> ndarray:
        """`displacement_operator` of the modes at rest."""
        return casing_axes(self.casing.tip.displacement_operator, self.casing.cone_angle)

    @cached_property
    def displacement_operator(self) -> ndarray:
        """Displacement of the contact nodes along the casing's normal, tangent and meridian, shape (3, nodes, modes).

        Per displacement u of all modes. It is that relative to the casing, whose modes count against it.
        """
        operator = self.operator_at_rest @ self._shapes
        if self.casing.ring is not None:
            operator[..., len(self.blade.frequencies) :] = self._ring_rows
        return operator

    @cached_property
    def static_shapes(self) -> ndarray:
        """Displacement that follows forces on the contact nodes at once, shape (modes at rest, 3 nodes).

        That of the modes that are not stepped, of forces in the directions of `displacement_operator`: see static_modes. No
        column where the forces are not those at t_n.
        """
        if not self.blade.grid.choice.second_order:
            return np.empty((len(self.blade.modes), 0))
        frequencies, modes = self.blade.static_modes
        rows = (self.operator_at_rest @ modes).reshape(3 * len(self.casing.tip.radius), len(frequencies))
        return (modes / frequencies**2) @ rows.T

    @cached_property
    def product_shapes(self) -> ndarray:
        """Displacement per product of second order, shape (modes at rest, products), see quadratic_motion; else no column."""
        return np.empty((len(self.blade.modes), 0)) if self.quadratic is None else self.quadratic.shapes

    @property
    def product_operator(self) -> ndarray:
        """Displacement of the contact nodes per product of second order, shape (3, nodes, products)."""
        return self.operator_at_rest @ self.product_shapes

    @cached_property
    def quadratic(self) -> QuadraticMotion | None:
        """Displacements of second order; None for a model without."""
        terms = self.blade.model.quadratic
        return None if terms is None else QuadraticMotion(self.blade, terms)

    def put_followers(self, displacement: ndarray, velocity: ndarray) -> None:
        """Put the blade's followers where they are pulled to, in place, in a displacement and a velocity of all modes."""
        if self.quadratic is not None:
            stepped = slice(len(self.blade.frequencies))
            self.quadratic.follow(displacement[stepped], velocity[stepped])

    def second_order_energy(self, displacement: ndarray, increment: ndarray) -> ndarray:
        """Elastic energy (J), shape (...,), beyond that of linear modes; 0 without displacements of second order.

        Of displacements u_n and increments of all modes, shape (..., modes). It is the mean of those of u_n and u_{n-1}, as the
        energy of a recursion is one between the two.
        """
        if self.quadratic is None:
            return np.zeros(displacement.shape[:-1])
        stepped = slice(len(self.blade.frequencies))
        both = (self.quadratic.energy(each[..., stepped]) for each in (displacement, displacement - increment))
        return 0.5 * sum(both, np.zeros(displacement.shape[:-1]))

    def static_energy(self, forces: ndarray) -> float:
        """Elastic energy (J) of the static modes under `forces` (N) on the nodes, shape (3, nodes).

        It is all the work that the forces have done on them: what follows at once is elastic.
        """
        frequencies, modes = self.blade.static_modes
        modal_forces = np.einsum("dk,dkm->m", forces, self.operator_at_rest @ modes) / frequencies
        return 0.5 * float(modal_forces @ modal_forces)

    @property
    def state_shapes(self) -> ndarray:
        """Displacement in the modes at rest per number of a snapshot.

        They are the stepped modes' u, products of second order, then the contact forces (N).
        """
        return np.hstack([self._shapes, self.product_shapes, self.static_shapes])

    @cached_property
    def output_operator(self) -> ndarray:
        """Rows of the samples, shape (6, numbers of a snapshot): see time_integration.simulate, TIP_POINTS and DIRECTIONS.

        After them one row for each of the casing's oscillators: displacement at the antinode of its mode (m).
        """
        radial, tangential, _ = self.blade.model.tip_displacement_operator
        normal = casing_axes(self.blade.model.tip_displacement_operator, self.casing.cone_angle)[0]
        rows = np.stack([normal, radial, tangential], axis=1)
        outputs = rows.reshape(-1, rows.shape[-1]) @ self.state_shapes
        if self.casing.ring is None:
            return outputs
        ring_part = np.zeros((len(self.casing.ring.size), outputs.shape[1]))
        np.fill_diagonal(ring_part[:, len(self.blade.frequencies) :], self.casing.ring.size)
        return np.concatenate([outputs, ring_part])

    @cached_property
    def contact_flexibility(self) -> ndarray:
        """Normal displacement (m/N) of the last node by `static_shapes` per force on the first, along each direction.

        Shape (3, nodes, nodes). That of the static modes.
        """
        nodes = len(self.casing.tip.radius)
        if not self.static_shapes.size:
            return np.zeros((3, nodes, nodes))
        return (self.operator_at_rest[0] @ self.static_shapes).T.reshape(3, nodes, nodes)

    @cached_property
    def coupling(self) -> ndarray:
        """Normal displacement (m/N) of the last node, one step on, per normal, tangential or meridional force on the first.

        Shape (3, nodes, nodes).
        """
        return self.coupling_of(self.recursion.inverse)

    def coupling_of(self, inverse: ndarray) -> ndarray:
        """`coupling` of the recursion's `inverse`, shape (..., modes); shape (..., 3, nodes, nodes)."""
        normal = self.displacement_operator[0]
        return np.stack([(rows * inverse[..., None, :]) @ normal.T for rows in self.displacement_operator], axis=-3)


@dataclass(frozen=True, eq=False)
class EdgeOperators:
    """Operators of the edge's nodes of a stepped `blade`, in the `casing` as they meet it; forces act on those of `contact`."""

    blade: SteppedBlade
    casing: CasingOfRun
    contact: ContactOperators

    @cached_property
    def motion(self) -> ContactOperators:
        """Operators from the motion of all modes to the edge."""
        return ContactOperators(self.blade, self.casing)

    @cached_property
    def flexibility(self) -> ndarray:
        """Normal displacement (m/N), shape (edge nodes, 3 contact nodes), that follows forces at once; see static_shapes."""
        return self.motion.operator_at_rest[0] @ self.contact.static_shapes

    @property
    def depth(self) -> float:
        """Distance (m) from the surface that a node meets first to the casing: the lining's thickness, 0 without one."""
        return self.casing.scene.wear_law.thickness

    @property
    def room(self) -> ndarray:
        """Distance (m) of each node of the edge from the round casing, behind a lining where there is one, shape (nodes,)."""
        return self.casing.clearance + self.depth

    @property
    def penetration_at_rest(self) -> float:
        """Penetration (m) of the edge into the casing before anything vibrates; 0 where it is clear of it."""
        return max(0.0, -float(self.room.min()))
