"""Simulated runs as an instrument would have measured them."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from r37core.base.variable import Variable
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.rom.recovery_nodes import RecoveryNodes
from r37core.sweep.parts import Parts
from r37core.time_integration import kept_numbers
from r37core.time_integration.finished_run import FinishedRun
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import DIRECTIONS, TIP_POINTS, Simulation
from r37core.time_integration.speed_arrays import STATUS
from r37core.time_integration.speed_file import read_speed
from r37core.time_integration.status import RunStatus
from r37studies.tip_timing import arrival_times

from .points import STRAIN, TIP_TIMING, WORN_DEPTH, Measurement

SECTORS = 360
"""Sectors round the casing of a profile."""


@dataclass(frozen=True, eq=False)
class ObservedBlade:
    """A blade's `model` in a scene, with its measurements by name; `parts`: files of the runs.

    `strains`, shape (measurements of strain, coordinates): strain at the gauges per unit of each reduced coordinate; `tip`:
    nodes of the tip line, of tip timing.
    """

    model: ContactModel
    choice: IntegrationChoice
    measurements: Mapping[str, Measurement]
    parts: Parts
    strains: np.ndarray = field(default_factory=lambda: np.empty((0, 0)))
    tip: RecoveryNodes | None = None

    def simulated(self, scene: Scene) -> Iterator[tuple[str, np.ndarray, str]]:
        """Name of each measurement, simulated values at its points, and a remark. Raises what a simulation raises."""
        speeds = sorted({speed for each in self.measurements.values() for speed in each.run_speeds})
        made_of = (scene, self.choice, [each.observes for each in self.measurements.values()])
        files = {speed: self.parts.file(speed, made_of, partial(self._run, scene, speed)) for speed in speeds}
        runs = {speed: read_speed(file, self.parts.arrays) for speed, file in files.items()}
        for name, measurement in self.measurements.items():
            yield name, *measurement.simulated(runs, name)

    def _run(self, scene: Scene, speed: float) -> dict[str, np.ndarray]:
        """Numbers of a run at a speed (rad/s): of each measurement its profile, or its statistic and amplitudes of orders."""
        samples = self.choice.samples_per_revolution if len(self.strains) else 0
        kept = self.choice.revolutions_in_statistic if samples else 0
        choice = replace(self.choice, snapshots_per_revolution=samples, snapshot_revolutions=kept)
        run = Simulation(self.model, speed, scene, choice).run()
        is_done = run.first_diverged is None
        numbers = {"status": np.array(int(RunStatus.COMPLETED if is_done else RunStatus.DIVERGED))}
        for name, measurement in self.measurements.items():
            if measurement.quantity == WORN_DEPTH:
                numbers[name] = self._worn(run, measurement)
            elif not is_done:
                numbers[name] = np.full(len(measurement.wanted_orders), np.inf)
            else:
                signal, samples = self._signal(run, measurement)
                numbers[name] = np.array([statistic(signal, samples, measurement, each) for each in measurement.wanted_orders])
        return numbers

    def _worn(self, run: FinishedRun, measurement: Measurement) -> np.ndarray:
        """The profile of the wear (m), or where no angles were measured its largest value."""
        lining = run.problem.scene.lining
        assert lining is not None
        wear, cut = run.states[0].wear, run.problem.casing.initial_wear
        numbers = kept_numbers.wear_numbers(wear, min(SECTORS, lining.bars), lining, cut)
        worn = numbers["wear"] if measurement.points.angles else np.atleast_1d(numbers["max_wear"])
        return worn if run.first_diverged is None else np.full(worn.shape, np.inf)

    def _signal(self, run: FinishedRun, measurement: Measurement) -> tuple[np.ndarray, int]:
        """The signal over the later revolutions, and how many samples a revolution has of it."""
        record, per_revolution = run.records[0], run.problem.choice.samples_per_revolution
        end = run.ending.revolutions
        first = max(end - self.choice.revolutions_in_statistic, 0)
        if measurement.quantity == STRAIN:
            strains = [each for each in self.measurements.values() if each.quantity == STRAIN]
            row = (self.strains @ self.model.to_reduced @ run.problem.contact.state_shapes)[strains.index(measurement)]
            return record.snapshots[-(end - first) * per_revolution :, : len(row)] @ row, per_revolution
        point = TIP_POINTS.index(measurement.tip_point)
        tip = record.samples.reshape(-1, len(TIP_POINTS), len(DIRECTIONS))[: end * per_revolution, point]
        if measurement.quantity != TIP_TIMING:
            direction = DIRECTIONS.index(measurement.quantity.removeprefix("displacement_"))
            return tip[first * per_revolution :, direction], per_revolution
        assert self.tip is not None
        speed, tangential = run.problem.speed, tip[:, DIRECTIONS.index("tangential")]
        times = np.arange(1, len(tip) + 1) * 2.0 * np.pi / (per_revolution * speed)
        probes, turns = np.array([measurement.probe]), np.arange(first + 1, end + 1)
        _, displacement = arrival_times(times, tangential, self.tip.points[-point], speed, probes, turns)
        return displacement[np.isfinite(displacement)], 1


def arrays_of(measurements: Mapping[str, Measurement]) -> dict[str, Variable]:
    """Arrays of a run's file: status, and the simulated values of each measurement at its points."""
    return STATUS | {name: Variable((name,), "1", f"simulated values of {name}, in its unit") for name in measurements}


def statistic(signal: np.ndarray, samples: int, measurement: Measurement, order: int) -> float:
    """Statistic of a signal of so many samples a revolution, or with an `order` the amplitude of that engine order."""
    if order:
        turn = np.exp(-2j * np.pi * order * np.arange(len(signal)) / samples)
        return float(2.0 * np.abs(np.mean(signal * turn)))
    return float(0.5 * np.ptp(signal) if measurement.statistic == "half_peak_to_peak" else np.sqrt(np.mean(signal**2)))
