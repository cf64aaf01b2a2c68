"""The time integration of the blades that a scene has: one, or those of a rotor, which meet one casing and wear one lining.

Blades of a rotor are coupled by the bars that they wear, and by nothing else. So what counts is the order in which they pass
a bar. A blade passes the casing from angle 0 to angle 0 in one go, and then the blade behind it does: every bar is then met in
the order of time, by every node that has a ring of bars of its own. Each blade is at the same steps of its revolution as a
single one; it starts with its first sample after time 0, at rest, where the casing is still round.

In an elastic casing that is not so: all blades move it at once. There all go step by step together, each at its angle.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel

from .compiled.passage import Passage, Start, advance_in_lockstep
from .initial_motion import InitialMotion, InitialMotionError
from .integration_choice import IntegrationChoice
from .problem import Problem
from .reference.engine import advance_together
from .rotor_blades import NO_ROTOR, blade_problems
from .settling import Ending, has_settled, parts_of_run, revolution_rms, wear_of
from .simulate import LEADING_EDGE, Simulation
from .state import SimulationRecord, SimulationState


@dataclass(frozen=True)
class BladesRecord:
    """Records of the blades: one of each, and where the samples lie in time.

    `late`, shape (blades,): time of a blade's samples after those of a blade at angle 0, in samples; `worn` (m3), shape
    (blades,): what each has worn off the lining, NaN of a single blade; `ending`: how the run of a single blade
    ended.
    """

    blades: tuple[SimulationRecord, ...]
    late: np.ndarray
    worn: np.ndarray
    ending: Ending

    @property
    def first_diverged(self) -> int | None:
        """Place of the blade that diverged first, None where none did; the others end within a revolution after it."""
        samples = {place: len(part.samples) for place, part in enumerate(self.blades) if part.diverged}
        return min(samples, key=samples.__getitem__, default=None)


class BladesSimulation:
    """The time integration of all blades of a scene at one speed (rad/s): of one, or of those of its `rotor`.

    Raises what Problem and blade_problems raise.
    """

    def __init__(self, model: ContactModel, speed: float, scene: Scene, choice: IntegrationChoice):
        self.rotor = scene.rotor
        if self.rotor is not None and choice.until_settled:
            raise ValueError(f"until: settled in a scene with a rotor; allowed: {NO_ROTOR}")
        if self.rotor is None:
            self.blades = [Simulation(model, speed, scene, choice)]
        else:
            self.blades = _beside_each_other(blade_problems(model, speed, scene, self.rotor, choice))

    @property
    def problems(self) -> list[Problem]:
        """Problem of each blade."""
        return [simulation.problem for simulation in self.blades]

    @property
    def problem(self) -> Problem:
        """Problem of the first blade: grid and casing are those of all."""
        return self.blades[0].problem

    @property
    def initial_wear(self) -> np.ndarray:
        """Wear (m) of each ring of the lining by the blade that reaches into it most, before anything vibrates, (rings, 1)."""
        return np.max([problem.casing.initial_wear for problem in self.problems], axis=0)

    @property
    def elastic(self) -> bool:
        """True where the blades press an elastic casing, which couples them."""
        return self.problem.casing.ring is not None

    def start(self, motion: InitialMotion | None = None) -> list[SimulationState]:
        """All blades at rest, in an unworn lining, or in one in which the longest have cut their way; one blade in `motion`.

        Raises what InitialMotion.put raises, and InitialMotionError for a rotor in motion.
        """
        if self.rotor is None:
            return [self.blades[0].start(motion)]
        if motion is not None:
            raise InitialMotionError("initial_displacement, initial_velocity: the blades of a rotor start at rest")
        states = [simulation.start() for simulation in self.blades]
        if self.problem.scene.lining is None:
            return states
        unworn = np.zeros((len(self.problem.casing.tip.radius), self.problem.casing.bars))
        shared = unworn + self.initial_wear
        for state, problem in zip(states, self.problems, strict=True):
            state.wear = shared if self.rotor.shared_lining else unworn + problem.casing.initial_wear
        return states

    def run(self, states: list[SimulationState]) -> BladesRecord:
        """Do the revolutions of the choice from the start, which the `states` are at; they are changed."""
        revolutions = self.problem.choice.revolutions
        if self.rotor is None:
            record, ending = run_of_blade(self.blades[0], states[0])
            return BladesRecord((record,), np.zeros(1), np.full(1, np.nan), ending)
        samples = revolutions * self.problem.choice.samples_per_revolution
        outs = [simulation.room(0, samples) for simulation in self.blades]
        engines, late = [simulation.engine for simulation in self.blades], np.zeros(len(self.blades))
        if self.problem.choice.engine == "reference":
            # in an elastic casing the problems have the angles
            angles = (0.0,) * len(self.blades) if self.elastic else self.rotor.angles
            done, worn = advance_together(engines, states, outs, angles, self.rotor.order)
        elif self.elastic:
            done, worn = advance_in_lockstep(engines, states, outs, self.rotor.order)
        else:
            starts = [self._start(angle) for angle in self.rotor.angles]
            done, worn = self._pass_by_pass(states, outs, starts, self.rotor.order, revolutions)
            late = np.array([start.late for start in starts])
        records = (blade.recorded(0, out, reached) for blade, out, reached in zip(self.blades, outs, done, strict=True))
        return BladesRecord(tuple(records), late, np.array(worn), Ending(revolutions))

    def energy(self, states: list[SimulationState]) -> float:
        """Energy (J) of the vibration of all blades, and of their elastic casing, which each state has."""
        total = self.blades[0].energy(states[0])
        for simulation, state in zip(self.blades[1:], states[1:], strict=True):
            own = np.arange(len(state.displacement)) < len(simulation.problem.blade.frequencies)
            total += simulation.energy(replace(state, displacement=state.displacement * own, increment=state.increment * own))
        return total

    def _start(self, angle: float) -> Start:
        """Start of a blade that stands at an angle (rad) at time 0: the whole samples before it passes angle 0."""
        per_revolution = self.problem.choice.samples_per_revolution
        # an angle that is a whole number of samples but for rounding has no share of one
        left = np.mod(angle, 2.0 * np.pi) / (2.0 * np.pi) * per_revolution
        left = float(np.round(left)) if abs(left - np.round(left)) < 1e-9 * per_revolution else float(left)
        whole = int(left)
        return Start((per_revolution - whole) % per_revolution, left - whole)

    def _pass_by_pass(
        self,
        states: list[SimulationState],
        outs: list[SimulationRecord],
        starts: list[Start],
        order: Sequence[int],
        revolutions: int,
    ) -> tuple[list[int], list[float]]:
        """Let blade after blade pass the casing in this order; returns the samples done of each, and its wear (m3)."""
        per_revolution = self.problem.choice.samples_per_revolution
        passages = [
            Passage(simulation.engine, state, out, start=start)
            for simulation, state, out, start in zip(self.blades, states, outs, starts, strict=True)
        ]
        total = revolutions * per_revolution
        # the first part of those that have not passed angle 0 yet, whole passes, and what is left
        for number in range(revolutions + 1):
            for place in order:
                until = min(total, number * per_revolution + (-starts[place].samples) % per_revolution)
                blocks = until - passages[place].done
                if blocks > 0:
                    passages[place].go_on(blocks)
                    if self.blades[place].diverged(outs[place], passages[place].done):
                        # the others go on until then: one of them may diverge before
                        total = passages[place].done
        for passage in passages:
            passage.end()
        return [passage.done for passage in passages], [passage.worn for passage in passages]


def run_of_blade(simulation: Simulation, state: SimulationState) -> tuple[SimulationRecord, Ending]:
    """The run of a single blade from its start, at which `state` is, and how it ended; see has_settled.

    Snapshots are those of the last `snapshot_revolutions`.
    """
    problem, choice = simulation.problem, simulation.problem.choice
    per_revolution, instants = choice.samples_per_revolution, choice.snapshots_per_revolution * choice.snapshot_revolutions
    out = simulation.room(0, choice.revolutions * per_revolution)
    risen = problem.casing.rise_time / (problem.grid.steps_per_revolution * problem.grid.time_step)
    done, revolutions, settled, growth, steps, rms = 0, 0, False, 0.0, 0.0, np.empty(0)
    for part in parts_of_run(choice):
        wear, contact = wear_of(state).copy(), float(state.totals["steps_in_contact"])
        advanced = simulation.fill(state, out, 0, part * per_revolution)
        motion = out.samples[done : done + advanced, LEADING_EDGE]
        done, revolutions = done + advanced, revolutions + part
        growth, steps = float(np.max(wear_of(state) - wear)), float(state.totals["steps_in_contact"]) - contact
        if advanced < part * per_revolution:
            break
        if choice.until_settled:
            rms = np.concatenate([rms, revolution_rms(motion, per_revolution)])
            settled = has_settled(rms, parts_of_run(choice)[-1], growth, risen)
        if settled:
            break
    record = simulation.recorded(0, out, done)
    if choice.until_settled:
        record = replace(record, snapshots=record.snapshots[max(len(record.snapshots) - instants, 0) :])
    return record, Ending(revolutions, settled, growth, steps)


def _beside_each_other(problems: Sequence[Problem]) -> list[Simulation]:
    """Simulations, one for each problem; that of the most modes is made first, so that the others have room in its capacity."""
    largest = int(np.argmax([len(problem.blade.frequencies) for problem in problems]))
    first = Simulation.build(problems[largest])
    return [
        first if place == largest else Simulation.build(problem, beside=first.engine) for place, problem in enumerate(problems)
    ]
