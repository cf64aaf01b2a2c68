"""Problem of a simulation: all that does not change while it runs, made once."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from r37core.contact.scene import Scene
from r37core.machine_code.alignment import padded
from r37core.rom.contact_model import ContactModel

from .casing_of_run import CasingOfRun
from .clearance import check_ring, check_room
from .contact_operators import ContactOperators, EdgeOperators
from .integration_choice import IntegrationChoice
from .step_checks import check_step
from .step_limit import UnstableStepError
from .stepped_blade import SteppedBlade
from .time_grid import TimeGrid


@dataclass(frozen=True, eq=False)
class Problem:
    """A blade's `model` at one `speed` (rad/s) in one `scene`, stepped as `choice` says, and what follows from these four.

    Each part has a subject: the `grid` in time, the `blade`'s modes, the `casing`, and the operators of `contact`.

    Raises UnstableStepError for a step at or above the stability limit 2/omega_max of central differences, or that of pressed
    nodes; TooFewStaticModesError where the contact forces would not be unique; LongRevolutionError for a revolution of too
    many steps; NoRoomError for a tip inside of the casing, and for a ring far from it; ValueError for an elastic casing with
    the exact gap.
    """

    model: ContactModel
    speed: float
    scene: Scene
    choice: IntegrationChoice

    def __post_init__(self) -> None:
        if self.scene.casing.ring and self.scene.exact_gap:
            raise ValueError("an elastic casing needs the linear gap: the exact one is that of a casing which keeps its shape")
        self.grid.check_table(padded(len(self.model.theta)))
        check_ring(self.model, self.scene)
        check_room(self.model, self.scene, np.array([self.speed]))
        check_step(self.contact)

    @cached_property
    def grid(self) -> TimeGrid:
        """Steps, samples and snapshots."""
        return TimeGrid(self.speed, self.choice)

    @cached_property
    def casing(self) -> CasingOfRun:
        """Casing that the contact nodes meet."""
        return CasingOfRun(self.model, self.scene, self.grid)

    @cached_property
    def blade(self) -> SteppedBlade:
        """The blade's modes."""
        return SteppedBlade(self.model, self.scene, self.grid, self.casing.cone_angle)

    @cached_property
    def contact(self) -> ContactOperators:
        """Operators from the motion of all modes to the contact nodes and back."""
        return ContactOperators(self.blade, self.casing)

    @cached_property
    def edge(self) -> EdgeOperators:
        """Operators from the motion and the contact forces to the nodes of the tip's edge."""
        return EdgeOperators(self.blade, CasingOfRun(self.model.edge, self.scene, self.grid), self.contact)


def stable_problem(model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice) -> Problem:
    """The problem, with a shorter step than the chosen one where that is unstable and the choice allows it.

    Raises what Problem raises.
    """
    while True:
        try:
            return Problem(model, speed, scene, choice)
        except UnstableStepError as error:
            # steps that a run keeps over many speeds do not become shorter
            if not choice.shorten or choice.steps_per_sample is not None:
                raise
            choice = replace(choice, time_step=error.shortened)
