"""Model of a blade for simulations: the reduced model in its modes at rest, and its contact nodes' displacement operator.

Light: the simulation jobs import it.

In the modes at rest the mass is the identity and the stiffness at speed Omega is diag(frequencies^2) + Omega^2 K1, so a
speed's own modes follow from a plain symmetric eigenproblem, without loss of digits and without SciPy.
"""

from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy import ndarray

from r37core.base.io import atomic_write, readable

from .logarithmic_stiffness import LogarithmicStiffness
from .quadratic_terms import QuadraticTerms
from .rotation import BucklingError, rotation_amplitudes

_NODE_FIELDS = ("displacement_operator", "radius", "theta", "rotation_shapes")
"""Fields that a contact node has, and a node of the edge, too."""


@dataclass(frozen=True, eq=False)
class ContactModel:
    """A blade in the coordinates of its modes at rest.

    `squared_frequencies` (rad2/s2), shape (modes,); `stiffness_per_square` (1/rad2), shape (modes, modes): change of the
    stiffness per Omega^2; `displacement_operator`, shape (3, nodes, modes): radial, tangential (growing theta) and axial
    displacement of the contact nodes, from leading to trailing edge; `radius` (m) and `theta` (rad) of the nodes, shape
    (nodes,); `tip_lengths` (m), shape (nodes,): length of tip along the casing's meridian that each stands for;
    `tip_cone_angle` (rad): half angle of the tip line's cone, negative where it narrows downstream;
    `tip_displacement_operator`, shape (3, 2, modes): the same displacements of the tip's leading and trailing edge;
    `to_reduced`, shape (coordinates, modes): modes at rest in the reduced model's coordinates. `rotation_shapes` (m s2/rad2),
    shape (3, nodes, shapes), and `rotation_stiffening` (s2/rad2), shape (shapes,): what rotation does to the contact nodes, in
    the same directions; see r37core.rom.rotation.
    `edge_displacement_operator`, `edge_radius`, `edge_theta`, `edge_rotation_shapes`: the same of all known nodes of the tip
    line, between the contact nodes, too; None where the contact nodes are all that is known of it.
    """

    squared_frequencies: ndarray
    stiffness_per_square: ndarray
    displacement_operator: ndarray
    radius: ndarray
    theta: ndarray
    tip_lengths: ndarray
    tip_cone_angle: float
    tip_displacement_operator: ndarray
    to_reduced: ndarray
    rotation_shapes: ndarray
    rotation_stiffening: ndarray
    logarithmic_stiffness: LogarithmicStiffness | None = None
    quadratic: QuadraticTerms | None = None
    edge_displacement_operator: ndarray | None = None
    edge_radius: ndarray | None = None
    edge_theta: ndarray | None = None
    edge_rotation_shapes: ndarray | None = None

    @property
    def tip_radius(self) -> float:
        """Largest radius (m) of the contact nodes."""
        return float(np.max(self.radius))

    @property
    def edge(self) -> Self:
        """The model with the nodes of the tip's edge in place of the contact nodes."""
        if self.edge_displacement_operator is None:
            return self
        edge: dict[str, Any] = {name: getattr(self, f"edge_{name}") for name in _NODE_FIELDS}
        edge |= dict.fromkeys((f"edge_{name}" for name in _NODE_FIELDS), None)
        return replace(self, **edge)

    @property
    def is_displaced(self) -> bool:
        """True where the modes are those about the equilibrium under rotation."""
        return self.logarithmic_stiffness is not None

    def modes_at(self, speed: float) -> tuple[ndarray, ndarray]:
        """Angular frequencies (rad/s), ascending, and modes, shape (modes at rest, modes), at `speed`; see BucklingError."""
        if self.logarithmic_stiffness is None:
            squares, modes = np.linalg.eigh(np.diag(self.squared_frequencies) + speed**2 * self.stiffness_per_square)
        else:
            squares, modes = self.logarithmic_stiffness.spectrum(self.squared_frequencies, speed)
        if not squares[0] > 0.0:
            raise BucklingError(speed)
        return np.sqrt(squares), modes

    def displaced(self, speeds: ndarray) -> ndarray:
        """Displacement (m) of the contact nodes by rotation at `speeds` (rad/s), (3, speeds, nodes); see BucklingError."""
        amplitudes = rotation_amplitudes(self.rotation_stiffening, speeds)
        return amplitudes @ self.rotation_shapes.swapaxes(1, 2)

    def spun(self, speed: float) -> Self:
        """The model with nodes where rotation at `speed` (rad/s) holds them; outputs stay as at rest. Raises BucklingError."""
        out, aside, _ = self.displaced(np.array([speed]))[:, 0]
        radius, turned = np.hypot(self.radius + out, aside), np.arctan2(aside, self.radius + out)
        radial, tangential, axial = self.displacement_operator
        cosine, sine = np.cos(turned)[:, None], np.sin(turned)[:, None]
        operator = np.stack([cosine * radial + sine * tangential, cosine * tangential - sine * radial, axial])
        return replace(self, radius=radius, theta=self.theta + turned, displacement_operator=operator)


_PARTS: dict[str, type] = {"logarithmic_stiffness": LogarithmicStiffness, "quadratic": QuadraticTerms}
"""Fields of a model that have fields themselves."""


def write_contact_model(model: ContactModel, file: Path | str) -> None:
    """Write the model as a small .npz; a term that it lacks is absent from the file."""
    content = asdict(model)
    for part in _PARTS:
        content |= {f"{part}.{name}": value for name, value in (content.pop(part) or {}).items()}
    with atomic_write(file) as partial:
        np.savez(partial, **{name: value for name, value in content.items() if value is not None})


def read_contact_model(file: Path | str) -> ContactModel:
    """The model of a file; InputFileError when it cannot be read."""
    with readable(file), np.load(file) as stored:
        content = {field.name: stored[field.name] for field in fields(ContactModel) if field.name in stored}
        content["tip_cone_angle"] = float(content["tip_cone_angle"])
        for part, kind in _PARTS.items():
            names = {field.name: f"{part}.{field.name}" for field in fields(kind)}
            if all(name in stored for name in names.values()):
                content[part] = kind(
                    **{name: stored[key] if stored[key].ndim else stored[key].item() for name, key in names.items()}
                )
        return ContactModel(**content)
