"""Content of a run-up's file: some numbers of every revolution, made while the run goes on."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.linalg import block_diag

from r37core.rom.contact_model import ContactModel
from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.operator import StressOperator
from r37core.stress.statistic import UNKNOWN, Strengths
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.kept_numbers import KEPT, amplitudes, append_rotation, in_directions
from r37core.time_integration.simulate import DIRECTIONS, TIP_POINTS
from r37core.time_integration.speed_arrays import SPECTRUM
from r37core.time_integration.status import RunStatus

from .cycle_damage import goodman_shares, largest_damage, operator_numbers
from .run_up_integration import IntegratedSegments, RunUpIntegration

_AT_ONCE, _INSTANTS_AT_ONCE = 32, 256
"""Revolutions that wait at most before they are reduced; instants whose stresses are in memory together."""


def record_run_up(
    integration: RunUpIntegration,
    results: Sequence[str],
    *,
    highest_order: int,
    stress: StressOperator | None,
    yield_stress: float,
    strengths: Strengths = UNKNOWN,
) -> dict[str, np.ndarray]:
    """Do a run-up, and keep of every whole revolution what is asked for in `results`.

    Returned are arrays of run_ups.dataset.VARIABLES. `miner_sum` is by these `strengths`, and infinite of a run that
    diverges. Such a run has the revolutions before; one that diverges while it wears the lining is that of the lining as new.
    """
    orders, run_up, choice = highest_order if "spectrum" in results else None, integration.run_up, integration.choice
    diverged = False
    # a blade of large displacements has an operator for each speed: here that of the mean speed
    stress = None if stress is None else stress.displaced(0.5 * (run_up.start + run_up.stop))
    for repeats in range(1 + run_up.worn):
        if repeats:
            integration.start(integration.state.wear)
        revolutions, reached = _Revolutions(integration.model, choice, orders, stress, "static_stress" in results), 0
        # numbers that the stress of all nodes is made of, rotation's in it, at all instants
        cycles: list[np.ndarray] = []
        for segments in integration.segments():
            diverged, reached = segments.diverged, reached + len(segments.samples)
            revolutions.add(segments)
            if stress is not None and "fatigue" in results:
                rotation = rotation_amplitudes(integration.model.rotation_stiffening, segments.snapshot_speeds)
                shapes = integration.model.to_reduced @ segments.shapes
                cycles.append(operator_numbers(stress, segments.snapshots, shapes, rotation))
        if diverged:
            break
    totals = integration.state.totals
    numbers: dict[str, Any] = {
        "status": int(RunStatus.DIVERGED if diverged else RunStatus.COMPLETED),
        "diverged_revolution": reached / choice.samples_per_revolution if diverged else np.nan,
        "largest_normal_force": totals["largest_force"],
        "casing_hits": totals["casing_hits"],
        "start_speed": run_up.start,
        "stop_speed": run_up.stop,
        "rate": run_up.rate(choice.samples_per_revolution),
        "revolutions_before": run_up.before,
        "revolutions_after": run_up.after,
        "worn": int(run_up.worn),
        "yield_stress": yield_stress,
    }
    arrays = revolutions.joined()
    if stress is not None and cycles:
        largest, damage, all_cycles = np.nan, np.inf if strengths.have_line else np.nan, np.concatenate(cycles)
        per_revolution = choice.snapshots_per_revolution
        if not diverged:
            largest, damage = largest_damage(stress, all_cycles[run_up.before * per_revolution :], strengths)
        numbers |= {"largest_stress_range": largest, "miner_sum": damage}
        count = len(arrays["speed"])
        whole = all_cycles[: count * per_revolution].reshape(count, per_revolution, all_cycles.shape[1])
        arrays["goodman_share"] = goodman_shares(stress, whole, strengths)
    if "energy" in results:
        numbers |= {**integration.balance, "stiffness_work": integration.stiffness_work}
    arrays |= {name: np.array(number) for name, number in numbers.items()}
    return {name: array for name, array in arrays.items() if name != "max_wear" or "wear" in results}


@dataclass
class _Revolutions:
    """Segments, reduced as soon as they make up some whole revolutions."""

    model: ContactModel
    choice: IntegrationChoice
    highest_order: int | None
    stress: StressOperator | None
    static_stress: bool
    waiting: dict[str, list[np.ndarray]] = field(default_factory=dict)
    reduced: list[dict[str, np.ndarray]] = field(default_factory=list)
    lasted: float = 0.0
    shapes: np.ndarray | None = None

    def add(self, segments: IntegratedSegments) -> None:
        """Add some segments; the last sample of those that diverged, which may be infinite, is left out."""
        count = len(segments.samples) - segments.diverged
        arrays = {
            "samples": segments.samples[:count].reshape(count, len(TIP_POINTS), len(DIRECTIONS)),
            "interval": 2.0 * np.pi / self.choice.samples_per_revolution / segments.speeds[:count],
            "wear": segments.wear[:count],
        }
        if self.stress is not None:
            if segments.shapes is not self.shapes:
                self.shapes, reduced = segments.shapes, self.model.to_reduced @ segments.shapes
                rotation = np.eye(len(self.model.rotation_stiffening) if self.static_stress else 0)
                self._to_stressed = block_diag(reduced, rotation)
                self._stress_of_shapes = self.stress.max_von_mises(self._to_stressed.T)
            numbers = segments.snapshots
            if self.static_stress:
                numbers = append_rotation(numbers, self.model, segments.snapshot_speeds)
            # of a sum of shapes the stress is no more than the sum of theirs
            arrays |= {"coordinates": numbers @ self._to_stressed.T, "bound": np.abs(numbers) @ self._stress_of_shapes}
        for name, array in arrays.items():
            self.waiting.setdefault(name, []).append(array)
        self._reduce(_AT_ONCE)

    def joined(self) -> dict[str, np.ndarray]:
        """All whole revolutions."""
        self._reduce(0)
        return {name: np.concatenate([part[name] for part in self.reduced]) for name in self.reduced[0]}

    def _reduce(self, fewest: int) -> None:
        """Reduce the whole revolutions that wait, where they are not fewer."""
        revolutions = sum(map(len, self.waiting["interval"])) // self.choice.samples_per_revolution
        if revolutions < fewest:
            return
        arrays = {}
        for name, parts in self.waiting.items():
            instants = name in ("coordinates", "bound")
            each = self.choice.snapshots_per_revolution if instants else self.choice.samples_per_revolution
            whole = np.concatenate(parts)
            self.waiting[name] = [whole[revolutions * each :]]
            arrays[name] = whole[: revolutions * each].reshape(revolutions, each, *whole.shape[1:])
        samples, lasting = arrays["samples"], arrays["interval"].sum(axis=1)
        time = self.lasted + np.cumsum(lasting)
        self.lasted = float(time[-1]) if revolutions else self.lasted
        reduced = {
            "speed": 2.0 * np.pi / lasting,
            "time": time,
            **in_directions("rms", np.sqrt(np.mean(samples**2, axis=1))),
            **in_directions("maximum", np.abs(samples).max(axis=1, initial=0.0)),
            "max_wear": arrays["wear"][:, -1],
        }
        if self.highest_order is not None:
            # of the leading edge, its directions before the samples
            kept = amplitudes(np.moveaxis(samples[:, :, 0, KEPT], 1, 2))[..., : self.highest_order + 1].astype(np.float32)
            reduced |= zip(SPECTRUM, kept.swapaxes(0, 1), strict=True)
        if self.stress is not None:
            reduced["max_von_mises"] = largest_stress(self.stress, arrays["coordinates"], arrays["bound"])
        self.reduced.append(reduced)


def largest_stress(stress: StressOperator, coordinates: np.ndarray, bound: np.ndarray) -> np.ndarray:
    """Largest von Mises stress (Pa) of each revolution, shape (revolutions,), of the instants that may have it alone.

    `coordinates`, shape (revolutions, instants, coordinates); `bound` (Pa), shape (revolutions, instants): what the stress of
    an instant does not exceed.
    """
    if not len(bound):
        return np.empty(0)
    revolutions, first = np.arange(len(bound)), bound.argmax(axis=1)
    largest = stress.max_von_mises(coordinates[revolutions, first])
    rest = bound > largest[:, None]
    rest[revolutions, first] = False
    rows, instants = np.nonzero(rest)
    for part in range(0, len(rows), _INSTANTS_AT_ONCE):
        some = slice(part, part + _INSTANTS_AT_ONCE)
        np.maximum.at(largest, rows[some], stress.max_von_mises(coordinates[rows[some], instants[some]]))
    return largest
