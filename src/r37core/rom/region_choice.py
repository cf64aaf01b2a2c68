"""Region of a blade where stress is looked for, as it is chosen. Light: the configuration imports it."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy import ndarray

from r37core.base.declared import Key
from r37core.mesh.blade_mesh import BladeMesh


@dataclass(frozen=True)
class RegionChoice:
    """Unclamped nodes within bounds of the span (0 at the root, 1 at the tip) and of x and z (m).

    `excluded_layers`: elements that hold a contact node or a clamped node are left out, and so many further layers round them
    as this number exceeds one: there a force on a single node and the clamping give stresses that grow with a finer mesh.
    `highest_frequency` (Hz): modes at rest above it do not count; infinite: all do. `integration_points`: stress is that of
    each element at the points that integrate its stiffness, as finite-element programs print it, not the mean at its nodes.
    """

    minimum_span: Annotated[float, Key("Lowest share of the span", ge=0, le=1)] = 0.0
    maximum_span: Annotated[float, Key("Highest share", ge=0, le=1)] = 1.0
    maximum_x: Annotated[float, Key("Upper bound of x (radial)", "_m", ge=1e-6, le=100)] = np.inf
    minimum_z: Annotated[float, Key("Lower bound of z (downstream)", "_m", ge=-100, le=100)] = -np.inf
    maximum_z: Annotated[float, Key("Upper bound of z", "_m", ge=-100, le=100)] = np.inf
    excluded_layers: Annotated[int, Key("Element layers left out round contact nodes and root", ge=0, le=20)] = 0
    highest_frequency: Annotated[float, Key("Highest frequency at rest of modes that count", "_hz", ge=1, le=1e6)] = np.inf
    integration_points: Annotated[
        bool,
        Key(
            "Where stress is evaluated: at nodes, averaged over elements, or at integration points",
            name="evaluated_at",
            words={"nodes": False, "integration_points": True},
        ),
    ] = False

    def description(self) -> str:
        """The region as results name it."""
        bounds = [("x <", self.maximum_x), ("z >", self.minimum_z), ("z <", self.maximum_z)]
        parts = [f"{name} {bound:g} m" for name, bound in bounds if np.isfinite(bound)]
        if (self.minimum_span, self.maximum_span) != (0.0, 1.0):
            parts = [f"{100.0 * self.minimum_span:g} to {100.0 * self.maximum_span:g}% span", *parts]
        layers = f"{self.excluded_layers} layer{'s' if self.excluded_layers > 1 else ''} of elements"
        text = ", ".join(parts) or "whole blade"
        text += f", without {layers} at contact nodes and root" if self.excluded_layers else ""
        text += f", modes up to {self.highest_frequency:g} Hz" if np.isfinite(self.highest_frequency) else ""
        return text + (", at integration points" if self.integration_points else "")

    def elements(self, mesh: BladeMesh, contact_nodes: ndarray) -> dict[str, ndarray]:
        """Nodes of the elements all of whose nodes qualify, by element type."""
        (x, _, z), span = mesh.points.T, mesh.parameters[:, 1]
        qualifies = (x < self.maximum_x) & (z > self.minimum_z) & (z < self.maximum_z)
        qualifies &= (span >= self.minimum_span) & (span <= self.maximum_span)
        root = mesh.node_set("root")
        qualifies[root] = False
        near = np.zeros(len(x), dtype=bool)
        near[contact_nodes] = near[root] = True
        for _ in range(self.excluded_layers - 1):
            near[np.concatenate([nodes[near[nodes].any(axis=1)].ravel() for nodes in mesh.blocks.values()])] = True
        chosen = {}
        for name, nodes in mesh.blocks.items():
            inside = qualifies[nodes].all(axis=1) & ~(near[nodes].any(axis=1) & (self.excluded_layers > 0))
            if inside.any():
                chosen[name] = nodes[inside]
        return chosen
