"""A case: what one job runs, as plain data. Light: the workflow imports it."""

from collections.abc import Mapping
from dataclasses import dataclass

from r37core.contact.scene import Scene
from r37core.fem.material import Material
from r37core.time_integration.integration_choice import IntegrationChoice
from r37studies.other_models import ModelChoice

HALF_STEP = "__half_step"
"""End of the name of a case that is another one with half its time step."""


@dataclass(frozen=True)
class Case:
    """A blade's model in one scene at some speeds, and what is kept of them.

    - `model`: made for the case, or this run's own on the tip line of this name.
    - `speeds`: rad/s, ascending. With a `crossing` they are shares of its speed in the Campbell diagram of the run.
    - `crossing`: mode whose crossing at the highest speed counts.
    - `results`: as of a scene.
    - `kept`: how much of spectrum and wear, as run_speed takes it.
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
    crossing: str = ""
    share_of_limit: float | None = None
    half_step: bool = False
