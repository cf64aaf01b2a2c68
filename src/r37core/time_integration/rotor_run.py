"""One speed of a whole rotor, from model to the small set of numbers that its file keeps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.fft import rfft

from r37core.contact.rotor import Rotor
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel
from r37core.stress.of_revolutions import largest_of_revolutions
from r37core.stress.operator import StressOperator

from .integration_choice import IntegrationChoice
from .kept_numbers import (
    KEPT,
    casing_numbers,
    energy_balance,
    rotation_of,
    snapshot_numbers,
    spectrum,
    status_numbers,
    wear_numbers,
)
from .rotor_simulation import RotorRecord, RotorSimulation
from .simulate import DIRECTIONS, TIP_POINTS
from .state import SimulationState

MOST_GROWTH = 200
"""Spans of revolutions whose largest motion and stress are kept of each blade: a file stays small with many blades."""


def run_rotor(
    model: ContactModel,
    speed: float,
    scene: Scene,
    choice: IntegrationChoice,
    results: Sequence[str],
    *,
    spectrum_highest_order: int,
    wear_angles: int,
    stress: StressOperator | None = None,
) -> dict[str, np.ndarray]:
    """Simulate one speed (rad/s) of a rotor: what run_speed keeps, of all blades together, and numbers of each blade.

    Of all blades: the largest of rms, peak, maxima, forces and stresses; the sum of hits and energies; the
    spectrum of the leading blade, the snapshots of the one with the largest stress. `status` is that of the rotor: all blades
    end when one diverges, whose snapshots are kept then.

    The motion of a blade is the displacement of its leading edge, normal and tangential together (KEPT): a blade in resonance
    may move along the tangent alone. `leader`: number of the blade with the largest motion; of a diverged run, of the one that
    diverged first.

    Of each blade, shape (blades,) first: `blade_number`, `blade_angle` (rad), `blade_frequency_factor`, `blade_longer` (m),
    `blade_rms` and `blade_peak` (m), of its motion over the last half, `blade_maximum` (m), shape (blades, spans), in spans of
    `span_revolutions` each, `blade_contact`, share of the time, `blade_worn` (m3), of the lining, and with stress
    `blade_max_von_mises` (Pa) in the last revolution and `blade_von_mises` (Pa), shape (blades, spans of the statistic's
    revolutions). `nodal_diameter` and `nodal_diameter_share`: see nodal_diameters.
    """
    assert scene.rotor is not None
    simulation = RotorSimulation(model, speed, scene, choice)
    states = simulation.start()
    record = simulation.run(states, choice.revolutions)
    samples = _samples(record, choice)
    per_revolution, first = choice.samples_per_revolution, choice.revolutions // 2
    half = samples[:, first * per_revolution :]
    maxima = np.abs(samples).reshape(len(samples), choice.revolutions, per_revolution, *samples.shape[2:]).max(axis=2)
    motion = np.linalg.norm(samples[:, :, 0, KEPT], axis=2)
    rms = np.sqrt(np.mean(motion[:, first * per_revolution :] ** 2, axis=1))
    ended = record.first_diverged
    leader = int(rms.argmax()) if ended is None else ended
    totals = np.array([state.totals for state in states])
    numbers = status_numbers(simulation.problem, None if ended is None else len(record.blades[ended].samples) / per_revolution)
    numbers |= {
        "rms": np.sqrt(np.mean(half**2, axis=1)).max(axis=0),
        "peak": maxima[:, first:].max(axis=(0, 1)),
        "revolution_maxima": maxima.max(axis=0),
        "share_of_time_in_contact": np.array((totals["steps_in_contact"] / np.maximum(totals["steps"], 1.0)).max()),
        "largest_normal_force": np.array(totals["largest_force"].max()),
        "casing_hits": np.array(totals["casing_hits"].sum()),
        "worst_complementarity": np.array(totals["worst_complementarity"].max()),
    }
    if scene.casing.changes_with_speed:
        numbers["clearance"] = np.min([problem.casing.clearance for problem in simulation.problems], axis=0)
    numbers |= _of_blades(simulation, states, record, motion.reshape(*maxima.shape[:2], per_revolution).max(axis=2), first)
    numbers |= {"blade_rms": rms, "leader": np.array(scene.rotor.numbers[leader])}
    numbers |= nodal_diameters(half[:, :, 0, KEPT], record.late, scene.rotor)
    if "spectrum" in results:
        numbers |= spectrum(half[leader, :, 0, KEPT], len(half[leader]) // per_revolution, spectrum_highest_order)
    if "stress" in results:
        numbers |= _stress(simulation, record, stress, "static_stress" in results)
    if "wear" in results:
        assert scene.lining is not None
        numbers |= wear_numbers(_worn(states), min(wear_angles, scene.lining.bars), scene.lining)
    if "energy" in results:
        work = sum(blade.work(state) for blade, state in zip(simulation.blades, states, strict=True))
        numbers |= energy_balance(work, float(totals["loss"].sum()), simulation.energy(states))
    if "casing" in results:
        # the record of any blade has it
        numbers |= casing_numbers(simulation.problem, record.blades[0], spectrum_highest_order)
    return numbers


def _samples(record: RotorRecord, choice: IntegrationChoice) -> np.ndarray:
    """Displacement (m) of all blades, shape (blades, samples, 2, 3), NaN from where a blade ended."""
    count = choice.revolutions * choice.samples_per_revolution
    samples = np.full((len(record.blades), count, len(TIP_POINTS), len(DIRECTIONS)), np.nan)
    for blade, part in zip(samples, record.blades, strict=True):
        # the last one before a divergence may be infinite
        reached = len(part.samples) - part.diverged
        blade[:reached] = part.samples[:reached].reshape(reached, *blade.shape[1:])
    return samples


def _of_blades(
    simulation: RotorSimulation,
    states: list[SimulationState],
    record: RotorRecord,
    maxima: np.ndarray,
    first: int,
) -> dict[str, np.ndarray]:
    """Numbers of each blade: see run_rotor. `maxima` (m), shape (blades, revolutions), of its motion."""
    rotor, totals = simulation.rotor, np.array([state.totals for state in states])
    growth, span = in_spans(maxima)
    return {
        "blade_number": np.array(rotor.numbers),
        "blade_angle": np.array(rotor.angles),
        "blade_frequency_factor": np.array(rotor.frequency_factors),
        "blade_longer": np.array(rotor.longer),
        "blade_peak": maxima[:, first:].max(axis=1),
        "blade_maximum": growth,
        "blade_contact": totals["steps_in_contact"] / np.maximum(totals["steps"], 1.0),
        "blade_worn": record.worn * simulation.problem.casing.bar_area,
        "span_revolutions": np.array(span),
    }


def in_spans(values: np.ndarray) -> tuple[np.ndarray, int]:
    """The largest of every span of revolutions along the last axis, in single precision, and how many revolutions it has.

    There are at most MOST_GROWTH spans; the last one may be shorter.
    """
    revolutions = values.shape[-1]
    span = -(-revolutions // MOST_GROWTH)
    return np.maximum.reduceat(values, np.arange(0, revolutions, span), axis=-1).astype(np.float32), span


def _worn(states: list[SimulationState]) -> np.ndarray:
    """Wear (m) of the lining that all share, or the largest of their own."""
    return np.max([state.wear for state in states if state.wear is not None], axis=0)


def _stress(
    simulation: RotorSimulation, record: RotorRecord, stress: StressOperator | None, static_stress: bool
) -> dict[str, np.ndarray]:
    """Of the blade with the largest stress what snapshot_numbers keeps, the largest history of all blades, and that of each."""
    history = None if stress is None else _histories(simulation, record, stress, static_stress)
    largest = 0 if history is None else int(np.nan_to_num(history[:, -1]).argmax())
    # a blade that another one ends may have no snapshots
    shown = largest if record.first_diverged is None else record.first_diverged
    numbers = snapshot_numbers(simulation.problems[shown], record.blades[shown], stress, static_stress)
    if history is None:
        return numbers
    of_blades, span = in_spans(history)
    return numbers | {
        "revolution_von_mises": history.max(axis=0),
        "blade_max_von_mises": history[:, -1],
        "blade_von_mises": of_blades,
        "stress_span_revolutions": np.array(span),
    }


def _histories(simulation: RotorSimulation, record: RotorRecord, stress: StressOperator, static_stress: bool) -> np.ndarray:
    """Largest stress (Pa) of each blade in each revolution of the statistic, shape (blades, revolutions); NaN where it ended.

    Blades with as many stepped modes are looked at together: their modes have the same shapes, and what follows a force at once
    is in proportion to the flexibility, 1/factor^2.
    """
    choice, model = simulation.problem.choice, simulation.problem.model
    rotation = rotation_of(simulation.problem, static_stress)
    history = np.full((len(record.blades), choice.snapshot_revolutions), np.nan, dtype=np.float32)
    groups: dict[tuple[int, int], list[int]] = {}
    for place, part in enumerate(record.blades):
        revolutions = len(part.snapshots) // choice.snapshots_per_revolution
        if revolutions:
            groups.setdefault((part.snapshots.shape[1], revolutions), []).append(place)
    for (_, revolutions), places in groups.items():
        instants = revolutions * choice.snapshots_per_revolution
        contact, factor = simulation.problems[places[0]].contact, simulation.rotor.frequency_factors[places[0]]
        stepped = contact.state_shapes.shape[1] - contact.static_shapes.shape[1]
        states = np.concatenate([record.blades[place].snapshots[:instants] for place in places])
        for row, place in enumerate(places):
            states[row * instants : (row + 1) * instants, stepped:] *= (factor / simulation.rotor.frequency_factors[place]) ** 2
        shapes = model.to_reduced @ contact.state_shapes
        largest = largest_of_revolutions(stress, states, shapes, rotation, choice.snapshots_per_revolution)
        history[places, :revolutions] = largest.reshape(len(places), revolutions)
    return history


def nodal_diameters(displacement: np.ndarray, late: np.ndarray, rotor: Rotor) -> dict[str, np.ndarray]:
    """How the motion of the blades is made of waves that run round the rotor.

    `displacement` (m), shape (blades, samples, directions), of whole revolutions; `late`, shape (blades,): see RotorRecord. A
    wave of n nodal diameters at frequency w is x_b(t) = Re(X exp(i(w t - n theta_b))), positive n in the sense of growing
    theta. With the Fourier transform X_bd(w) of each blade's motion along the direction d the share of n is

        P_n = sum_d,w |sum_b X_bd(w) exp(i n theta_b)|^2 / (B sum_d,w,b |X_bd(w)|^2),

    over positive frequencies. For equal angles the shares add up to 1 (Parseval). `nodal_diameter`: from -(B-1)//2 to B//2.
    """
    blades, samples = displacement.shape[:2]
    diameters = np.arange(-((blades - 1) // 2), blades // 2 + 1)
    waves = rfft(displacement, axis=1)[:, 1:]
    waves = waves * np.exp(-2j * np.pi / samples * late[:, None] * np.arange(1, waves.shape[1] + 1))[..., None]
    with np.errstate(invalid="ignore"):  # blades that stand still have no share
        power = np.sum(np.abs(waves) ** 2)
        of_diameter = np.exp(1j * np.outer(diameters, rotor.angles)) @ waves.reshape(blades, -1)
        share = np.sum(np.abs(of_diameter) ** 2, axis=1) / (blades * power)
    return {"nodal_diameter": diameters, "nodal_diameter_share": share}
