"""The time integration of the blades of a rotor, which meet one casing and wear one lining.

They are coupled by the bars that they wear, and by nothing else. So what counts is the order in which they pass a bar. A blade
passes the casing from angle 0 to angle 0 in one go, and then the blade behind it does: every bar is then met in the order of
time, by every node that has a ring of bars of its own. Each blade is at the same steps of its revolution as a single one; it
starts with its first sample after time 0, at rest, where the casing is still round.

In an elastic casing that is not so: all blades move it at once. There all go step by step together, each at its angle.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel

from .compiled.engine import Passage, advance_in_lockstep, go_on
from .integration_choice import IntegrationChoice
from .problem import Problem
from .rotor_blades import NO_ROTOR, blade_problems
from .rotor_numbers import RotorRun
from .settling import Ending
from .simulate import Simulation
from .state import SimulationRecord, SimulationState


class RotorSimulation:
    """The time integration of all blades of a scene's rotor at one speed (rad/s).

    Raises what Problem and blade_problems raise.
    """

    blade_class: ClassVar[type[Simulation]] = Simulation
    """Class of the simulation of each blade."""

    def __init__(self, model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice):
        assert scene.rotor is not None
        if choice.until_settled:
            raise ValueError(f"until: settled in a scene with a rotor; allowed: {NO_ROTOR}")
        self.rotor = scene.rotor
        problems = blade_problems(model, speed, scene, self.rotor, choice)
        # all with the capacity and the casing's tables of the problem of the most modes
        largest = self.blade_class.build(max(problems, key=lambda problem: len(problem.blade.frequencies)))
        self.blades = [self.blade_class.build(problem, beside=largest.engine) for problem in problems]

    @property
    def problem(self) -> Problem:
        """Problem of the first blade: grid and casing are those of all."""
        return self.blades[0].problem

    def start(self) -> list[SimulationState]:
        """All blades at rest, in an unworn lining, or in one in which the longest have cut their way."""
        states = [simulation.start() for simulation in self.blades]
        casings = [simulation.problem.casing for simulation in self.blades]
        unworn = np.zeros((len(casings[0].tip.radius), casings[0].bars))
        shared = unworn + np.max([casing.initial_wear for casing in casings], axis=0)
        for state, casing in zip(states, casings, strict=True):
            state.wear = shared if self.rotor.shared_lining else unworn + casing.initial_wear
        return states

    def run(self) -> RotorRun:
        """The run of the choice from the start on."""
        states, revolutions = self.start(), self.problem.choice.revolutions
        energy = self.energy(states)
        samples = revolutions * self.problem.choice.samples_per_revolution
        outs = [simulation.room(0, samples) for simulation in self.blades]
        done, worn, late = self.advance(states, outs)
        records = [blade.recorded(0, out, reached) for blade, out, reached in zip(self.blades, outs, done, strict=True)]
        return RotorRun(
            problems=[simulation.problem for simulation in self.blades],
            states=states,
            records=records,
            ending=Ending(revolutions),
            energy_change=self.energy(states) - energy,
            contact_work=sum(blade.work(state) for blade, state in zip(self.blades, states, strict=True)),
            frequency_factors=self.rotor.frequency_factors,
            rotor=self.rotor,
            late=np.array(late),
            worn=np.array(worn),
        )

    def advance(
        self, states: list[SimulationState], outs: list[SimulationRecord]
    ) -> tuple[list[int], list[float], Sequence[float]]:
        """Do the steps of every row of the samples; returns the rows done of each blade, what it has worn off the lining (m3),
        and the share of a sample by which it starts late.
        """
        if self.problem.casing.ring is not None:
            engines = [simulation.engine for simulation in self.blades]
            return *advance_in_lockstep(engines, states, outs, self.rotor.order), [0.0] * len(engines)
        starts = [self._start(angle) for angle in self.rotor.angles]
        return *self._pass_by_pass(states, outs, starts), [share for _, share in starts]

    def energy(self, states: list[SimulationState]) -> float:
        """Energy (J) of the vibration of all blades, and of their elastic casing, which each state has."""
        total = self.blades[0].energy(states[0])
        for simulation, state in zip(self.blades[1:], states[1:], strict=True):
            own = np.arange(len(state.displacement)) < len(simulation.problem.blade.frequencies)
            total += simulation.energy(replace(state, displacement=state.displacement * own, increment=state.increment * own))
        return total

    def _start(self, angle: float) -> tuple[int, float]:
        """Samples since a blade that stands at an angle (rad) has passed angle 0 when it starts, and the share that it is late.

        It starts with its first whole sample after time 0.
        """
        per_revolution = self.problem.choice.samples_per_revolution
        # an angle that is a whole number of samples but for rounding has no share of one
        left = np.mod(angle, 2.0 * np.pi) / (2.0 * np.pi) * per_revolution
        left = float(np.round(left)) if abs(left - np.round(left)) < 1e-9 * per_revolution else float(left)
        whole = int(left)
        return (per_revolution - whole) % per_revolution, left - whole

    def _pass_by_pass(
        self, states: list[SimulationState], outs: list[SimulationRecord], starts: list[tuple[int, float]]
    ) -> tuple[list[int], list[float]]:
        """Let blade after blade pass the casing in the rotor's order; returns the samples done of each, and its wear (m3)."""
        per_revolution, total = self.problem.choice.samples_per_revolution, len(outs[0].samples)
        passages = [
            Passage(simulation.engine, state, out, None, *start)
            for simulation, state, out, start in zip(self.blades, states, outs, starts, strict=True)
        ]
        # the first part of those that have not passed angle 0 yet, whole passes, and what is left
        for number in range(self.problem.choice.revolutions + 1):
            for place in self.rotor.order:
                until = min(total, number * per_revolution + (-starts[place][0]) % per_revolution)
                blocks = until - passages[place].done
                if blocks > 0:
                    go_on([passages[place]], blocks)
                    if self.blades[place].diverged(outs[place], passages[place].done):
                        # the others go on until then: one of them may diverge before
                        total = passages[place].done
        for passage in passages:
            passage.end()
        return [passage.done for passage in passages], [passage.worn for passage in passages]
