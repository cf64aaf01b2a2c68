"""A case: what one job runs, as plain data. Light: the workflow imports it."""

import math
from collections.abc import Mapping
from dataclasses import astuple, dataclass
from typing import Self

from r37core.contact.scene import Scene
from r37core.fem.material import Material
from r37core.time_integration.integration_choice import IntegrationChoice

HALF_STEP = "__half_step"
"""End of the name of a case that is another one with half its time step."""

LEVEL = "level"
"""The parameter that changes everything at once: the fidelity level."""

OWN_MESH = 0
"""Number of nodes that stands for the mesh of the run, as for a blade of another program."""


def tip_elements(nodes: int) -> int:
    """Elements along the tip of a mesh of so many nodes: a multiple of 7, for 8 evenly spaced boundary nodes."""
    return 7 * max(1, round(0.04 * math.sqrt(nodes)))


@dataclass(frozen=True)
class ModelChoice:
    """A model of a blade made for some cases, with the tip line and contact of the run.

    - `nodes`: of the mesh, or OWN_MESH. `boundary_nodes`: 0 for as many as the mesh has room for by default.
    - `stress_region`: `whole` blade or `submesh`, the regions of this run, where stress is recovered.
    """

    nodes: int
    boundary_nodes: int
    fixed_interface_modes: int
    stress_region: str

    @property
    def name(self) -> str:
        """Folder of the model."""
        return "_".join(map(str, astuple(self)))

    @classmethod
    def named(cls, name: str) -> Self:
        """The choice of this name."""
        nodes, boundary_nodes, modes, region = name.split("_")
        return cls(int(nodes), int(boundary_nodes), int(modes), region)


MODEL_NAME = r"\d+_\d+_\d+_(submesh|whole)"
"""Pattern of ModelChoice.name."""


MODEL_FILES = {
    "rom": "<results>/cases/{blade}/{model}/rom.nc",
    "contact": "<results>/cases/{blade}/{model}/contact.npz",
    "cost": "<results>/cases/{blade}/{model}/cost.json",
}
"""Files of a model by kind."""


@dataclass(frozen=True)
class Case:
    """A blade's model in one scene at some speeds, and what is kept of them.

    - `model`: made for the case, or this run's own on the tip line of this name.
    - `speeds`: rad/s, ascending. With a `crossing` they are shares of its speed in the Campbell diagram of the run.
    - `crossing`: mode and engine order; without an order the one at the highest speed.
    - `results`: as of a scene, and `instants`, the stress at each instant of the last revolution.
    - `kept`: how much of spectrum and wear, as run_speed takes it.
    - `history_speeds`: speeds whose stress is kept for every revolution.
    - `share_of_limit`: the time step is this share of the blade's stability limit under central differences.
    - `half_step`: half the step that would be taken otherwise.
    """

    blade: str
    model: ModelChoice | str
    scene: Scene
    choice: IntegrationChoice
    speeds: tuple[float, ...]
    results: tuple[str, ...]
    material: Material | None
    kept: Mapping[str, int]
    crossing: tuple[str, int | None] | None = None
    history_speeds: tuple[float, ...] = ()
    share_of_limit: float | None = None
    half_step: bool = False

    def __post_init__(self) -> None:
        if list(self.speeds) != sorted(set(self.speeds)):
            raise ValueError(f"speeds of a case: found {self.speeds}; allowed: ascending, none twice")
