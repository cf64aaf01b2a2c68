"""Models of a blade beside that of the run, on another mesh or with another basis: their choice and files."""

import math
from dataclasses import astuple, dataclass
from typing import Self

OWN_MESH = 0
"""Number of nodes that stands for the mesh of the run, as for a blade of another program."""


def tip_elements(nodes: int) -> int:
    """Elements along the tip of a mesh of so many nodes: a multiple of 7, for 8 evenly spaced boundary nodes."""
    return 7 * max(1, round(0.04 * math.sqrt(nodes)))


@dataclass(frozen=True)
class ModelChoice:
    """A model of a blade made for some cases, with the tip line and contact of the run.

    - `nodes`: of the mesh, or OWN_MESH. `boundary_nodes`: 0 for as many as the mesh has room for by default.
    """

    nodes: int
    boundary_nodes: int
    fixed_interface_modes: int

    @property
    def name(self) -> str:
        """Folder of the model."""
        return "_".join(map(str, astuple(self)))

    @classmethod
    def named(cls, name: str) -> Self:
        """The choice of this name."""
        return cls(*map(int, name.split("_")))


MODEL_NAME = r"\d+_\d+_\d+"
"""Pattern of ModelChoice.name."""

MODEL_FILES = {
    "rom": "<results>/cases/{blade}/{model}/rom.nc",
    "contact": "<results>/cases/{blade}/{model}/contact.npz",
    "cost": "<results>/cases/{blade}/{model}/cost.json",
}
"""Files of a model by kind."""
