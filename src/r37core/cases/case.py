"""A case: what one job runs, as plain data. Light: the workflow imports it."""

from collections.abc import Mapping
from dataclasses import dataclass

from r37core.contact.scene import Scene
from r37core.fem.material import Material
from r37core.time_integration.integration_choice import IntegrationChoice

OWN_MESH = 0
"""Number of nodes that stands for the mesh of the run, as for a blade of another program."""


@dataclass(frozen=True)
class ModelChoice:
    """A model of a blade made for some cases: nodes of the mesh (or OWN_MESH) and of the tip line, fixed-interface modes.

    `boundary_nodes`: number of contact nodes, 0 for as many as the mesh has room for by default.

    `whole_blade_stress`: stress is recovered on the whole blade, else on the submesh of this run.
    """

    nodes: int
    boundary_nodes: int
    fixed_interface_modes: int
    whole_blade_stress: bool
    tip_line: str
    corners: bool

    @property
    def name(self) -> str:
        """Folder of the model; each part is a wildcard of the rule that makes it."""
        region, ends = "whole" if self.whole_blade_stress else "submesh", "corners" if self.corners else "inside"
        numbers = f"{self.nodes}_{self.boundary_nodes}_{self.fixed_interface_modes}"
        return f"{numbers}_{region}_{self.tip_line}_{ends}"


MODEL_NAME = r"\d+_\d+_\d+_(submesh|whole)_(pressure_edge|camber|suction_edge)_(corners|inside)"
"""Pattern of ModelChoice.name."""


def model_of_name(name: str) -> ModelChoice:
    """The choice of this name."""
    nodes, boundary_nodes, modes, region, *line, ends = name.split("_")
    return ModelChoice(int(nodes), int(boundary_nodes), int(modes), region == "whole", "_".join(line), ends == "corners")


@dataclass(frozen=True)
class Crossing:
    """Where a mode crosses an engine order in the Campbell diagram of the run; without an order at the highest speed."""

    mode: str
    engine_order: int | None


@dataclass(frozen=True)
class Case:
    """A blade's model in one scene at some speeds, and what is kept of them.

    - `model`: made for the case, or this run's own on the tip line of this name.
    - `scene`: None where the case is refused; `refused` has the reason.
    - `speeds`: rad/s, ascending. With a `crossing` they are shares of its speed.
    - `results`: as of a scene, and `instants`, the stress at each instant of the last revolution.
    - `kept`: how much of spectrum and wear, as run_speed takes it.
    - `history_speeds`: speeds whose stress is kept for every revolution; None: all.
    - `share_of_limit`: the time step is this share of the blade's stability limit under central differences.
    - `half_step`: half the step that would be taken otherwise.
    - `what`: words for the result's attributes.
    """

    blade: str
    model: ModelChoice | str
    scene: Scene | None
    choice: IntegrationChoice
    speeds: tuple[float, ...]
    results: tuple[str, ...]
    material: Material | None
    kept: Mapping[str, int]
    crossing: Crossing | None = None
    history_speeds: tuple[float, ...] | None = ()
    share_of_limit: float | None = None
    half_step: bool = False
    refused: str = ""
    what: str = ""

    def __post_init__(self) -> None:
        if list(self.speeds) != sorted(set(self.speeds)):
            raise ValueError(f"speeds of a case: found {self.speeds}; allowed: ascending, none twice")
