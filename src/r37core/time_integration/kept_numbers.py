"""Results kept of a run at one speed: numbers of its samples, snapshots and wear, as its file has them."""

from typing import Any

import numpy as np
from numpy import ndarray
from numpy.fft import rfft  # NumPy imports it when it is used, which would be in each of a server's jobs

from r37core.contact.casing import casing_axes
from r37core.contact.laws import lines_of_bar, used_thickness, wear_at_the_casing
from r37core.contact.ring import RingMotion
from r37core.contact.scene import Friction, Lining, Scene
from r37core.rom.contact_model import ContactModel
from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.operator import StressOperator, StressOperators, judged_operator
from r37core.stress.revolutions import largest_cycles, largest_of_revolutions, stress_cycles

from .finished_run import FinishedRun
from .integration_choice import HEATED
from .problem import Problem
from .simulate import DIRECTIONS, LEADING_EDGE
from .speed_arrays import OF_LINING, PLACE_OF_STRESS, SPECTRUM
from .state import TOTALS, SimulationRecord, SimulationState
from .status import RunStatus

_WEAR_LOBES = 20
_ROUND_OFF = 1e-9
"""Relative margin of a bar's penetration at the casing; the compiled code has the same."""
MELTING = 2.8e4
"""Heat per second (W) and length of tip (m) that melts 4 mm2 of its section in a second: steel takes 7 GJ/m3 until it is molten
(3.8 MJ/(m3 K) over 1,400 K, and 1.7 GJ/m3)."""
KEPT = LEADING_EDGE
"""Directions of the spectrum."""


def whole(samples: ndarray, count: int, diverged: bool) -> ndarray:
    """Samples extended to the `count` asked for: NaN from where a run ended, and in place of the last one that diverged."""
    # which may be infinite
    return extended(samples[: len(samples) - diverged], count)


def largest_of_each(revolutions: int, samples: ndarray) -> ndarray:
    """Largest magnitude in each revolution of `samples`, shape (samples, ...): shape (revolutions, ...); NaN stays."""
    # as `max` along an axis of its own, which takes seven times as long
    firsts = np.arange(revolutions) * (len(samples) // revolutions)
    return np.maximum(*(np.abs(ends.reduceat(samples, firsts)) for ends in (np.maximum, np.minimum)))


def extended(values: ndarray, count: int) -> ndarray:
    """Values along the first axis and NaN after them, up to a `count` of rows."""
    if len(values) == count:
        return values
    return np.concatenate([values, np.full((count - len(values), *values.shape[1:]), np.nan)])


def status_numbers(problem: Problem, reached: float | None) -> dict[str, Any]:
    """Status of a run, and what it was made with: see run_speed. `reached`: revolution of a divergence, None without one."""
    diverged_at = np.nan if reached is None else reached
    return {
        "status": int(RunStatus.COMPLETED if reached is None else RunStatus.DIVERGED),
        "speed": problem.speed,
        "diverged_revolution": diverged_at,
        "diverged_time": diverged_at * 2.0 * np.pi / problem.speed,
        "time_step": problem.grid.time_step,
        "casing_cone_angle": problem.casing.cone_angle,
        "lined": int(problem.scene.lined),
        "casing_lobes": problem.scene.casing.lobes,
    }


def snapshot_numbers(
    problem: Problem, record: SimulationRecord, stress: StressOperators | None, static_stress: bool
) -> dict[str, Any]:
    """Numbers kept of the snapshots of the last revolution: see run_speed."""
    shapes = problem.model.to_reduced @ problem.contact.state_shapes
    coordinates = record.snapshots[-problem.choice.snapshots_per_revolution :] @ shapes.T
    if static_stress:
        coordinates = append_rotation(coordinates, problem.model, problem.speed)
    # a stress of them differs by 1e-7 of the largest, in two thirds of the file
    coordinates = coordinates.astype(np.float32)
    if stress is None:
        return {"snapshots": coordinates}
    largest = [np.nan if record.diverged else operator.max_von_mises(coordinates).max() for operator in stress.values()]
    return {
        "snapshots": coordinates,
        "region": list(stress),
        "max_von_mises_last_revolution": largest,
        "stress_region": [operator.region for operator in stress.values()],
        "static_stress": int(judged_operator(stress).have_rotation(coordinates)),
    }


def stress_histories(run: FinishedRun, stress: StressOperators, static_stress: bool) -> tuple[ndarray, ndarray]:
    """Largest stress (Pa) of each blade in each revolution with snapshots, NaN where it ended, and its node in the operator.

    Both by region, shape (regions, blades, revolutions); of regions that do not decide in those of the statistic. Blades with
    as many stepped modes are looked at together: their modes have the same shapes, and what follows a force at once is in
    proportion to the flexibility, 1/factor^2 for a factor of the frequencies.
    """
    problems, records, factors = run.problems, run.records, run.frequency_factors
    choice, per_revolution = problems[0].choice, problems[0].choice.snapshots_per_revolution
    model, speed = problems[0].model, problems[0].speed
    rotation = rotation_amplitudes(model.rotation_stiffening, speed) if static_stress else np.empty(0)
    history = np.full((len(stress), len(records), choice.snapshot_revolutions), np.nan, dtype=np.float32)
    nodes = np.zeros(history.shape, dtype=int)
    judged, groups = judged_operator(stress), dict[tuple[int, int], list[int]]()
    for place, record in enumerate(records):
        revolutions = len(record.snapshots) // per_revolution
        if revolutions:
            groups.setdefault((record.snapshots.shape[1], revolutions), []).append(place)
    for (_, revolutions), places in groups.items():
        instants, contact = revolutions * per_revolution, problems[places[0]].contact
        states = [records[place].snapshots[:instants] for place in places]
        stepped = contact.state_shapes.shape[1] - contact.static_shapes.shape[1]
        for row, place in enumerate(places[1:], 1):
            states[row] = states[row].copy()
            states[row][:, stepped:] *= (factors[places[0]] / factors[place]) ** 2
        shapes = model.to_reduced @ contact.state_shapes
        joined = states[0] if len(states) == 1 else np.concatenate(states)
        for region, operator in enumerate(stress.values()):
            first = 0 if operator is judged else max(revolutions - choice.revolutions_in_statistic, 0)
            looked_at = joined.reshape(len(places), instants, -1)[:, first * per_revolution :].reshape(-1, joined.shape[1])
            worst = largest_of_revolutions(operator, looked_at, shapes, rotation, per_revolution)
            for kept, values in zip((history, nodes), worst, strict=True):
                kept[region, places, first:revolutions] = values.reshape(len(places), revolutions - first)
    return history, nodes


def worst_places(run: FinishedRun, stress: StressOperators, history: ndarray, nodes: ndarray) -> dict[str, ndarray]:
    """Chord, span and side by region of the largest stress of any revolution, of all blades; NaN if diverged.

    `history` and `nodes`: see stress_histories.
    """
    if run.first_diverged is not None:
        return dict.fromkeys(PLACE_OF_STRESS, np.full(len(stress), np.nan))
    regions = zip(stress.values(), history, nodes, strict=True)
    places = np.array([operator.place(worst.flat[np.nanargmax(largest)]) for operator, largest, worst in regions])
    return dict(zip(PLACE_OF_STRESS, places.T, strict=True))


def casing_numbers(problem: Problem, record: SimulationRecord, revolutions: int, highest_order: int) -> dict[str, ndarray]:
    """Waves of the elastic casing in the statistic of a run of so many revolutions: see casing_waves."""
    ring, choice = problem.casing.ring, problem.choice
    assert ring is not None and record.casing is not None
    per_revolution = choice.samples_per_revolution
    count, first = revolutions * per_revolution, (revolutions - choice.revolutions_in_statistic) * per_revolution
    half = whole(record.casing, count, len(record.casing) < count or record.diverged)[first:]
    return casing_waves(half, ring, problem.speed, choice.revolutions_in_statistic, highest_order)


def append_rotation(coordinates: ndarray, model: ContactModel, speeds: float | ndarray) -> ndarray:
    """Coordinates of the vibration, shape (instants, coordinates), and after them the amplitudes of rotation's shapes.

    `speeds` (rad/s): one of all, or that of each instant.
    """
    amplitudes = rotation_amplitudes(model.rotation_stiffening, speeds)
    return np.hstack([coordinates, np.broadcast_to(amplitudes, (len(coordinates), amplitudes.shape[-1]))])


def in_directions(kind: str, displacement: ndarray) -> dict[str, ndarray]:
    """An array for each of the DIRECTIONS, which are the last axis."""
    return {f"{kind}_{direction}": displacement[..., column] for column, direction in enumerate(DIRECTIONS)}


def spectrum(displacement: ndarray, revolutions: int, highest_order: int) -> dict[str, ndarray]:
    """Amplitude (m) of displacements, shape (KEPT, samples), at multiples of 1/revolutions of the engine order."""
    amplitude = amplitudes(displacement)
    count = min(highest_order * revolutions + 1, amplitude.shape[1])
    kept = zip(SPECTRUM, amplitude[:, :count].astype(np.float32), strict=True)
    return {**dict(kept), "engine_order": np.arange(count) / revolutions}


def amplitudes(values: ndarray) -> ndarray:
    """Amplitudes of the Fourier series of real values, along the last axis; the first is the mean's size."""
    sizes = 2.0 * np.abs(rfft(values)) / values.shape[-1]
    sizes[..., 0] /= 2.0
    return sizes


def wear_numbers(wear: ndarray, angles: int, lining: Lining, cut: ndarray) -> dict[str, Any]:
    """Largest `wear` (m), shape (rings, bars), over the rings: in each of `angles` sectors, and its lobes.

    And the thickness of the `lining` that is used, and the share of the bars that are worn through to the casing behind it, in
    any ring. `cut` (m), shape (rings, 1): wear before anything vibrated, which leaves nothing that springs back.
    """
    pressed = wear > cut
    through = pressed & (wear >= (1.0 - _ROUND_OFF) * wear_at_the_casing(lining))
    used = used_thickness(float(np.max(wear, where=pressed, initial=0.0)), lining)
    profile = wear.max(axis=0)
    sectors = np.linspace(0, len(profile), angles, endpoint=False).astype(int)
    depths = np.maximum.reduceat(profile, sectors) if len(profile) >= angles else profile[sectors]
    return {
        "wear": depths.astype(np.float32),
        "max_wear": profile.max(),
        "used_thickness": max(used, float(cut.max())),
        "worn_through_share": np.mean(through.any(axis=0)),
        "wear_harmonic": amplitudes(profile)[: _WEAR_LOBES + 1],
    }


def energy_balance(work: float, loss: float, change: float, stiffness_work: float = 0.0) -> dict[str, ndarray]:
    """Work of the contact forces, loss to damping, change of energy, and what does not close (all J).

    `stiffness_work`: what a changing speed brings to the vibration.
    """
    return {
        "contact_work": np.array(work),
        "damping_loss": np.array(loss),
        "energy_change": np.array(change),
        "energy_residual": np.array(change - work + loss - stiffness_work),
    }


def melting_power(model: ContactModel, friction: Friction | None) -> float:
    """Power of the friction (W) of which the share that enters the tip melts it in a second."""
    return float(MELTING / (friction.heat_share if friction else 1.0) * model.tip_lengths.sum())


def limit_numbers(run: FinishedRun, totals: ndarray) -> dict[str, Any]:
    """Numbers that the model's limits are of (results.limits), from the `totals` of each blade, shape (blades,).

    `energy_residual_share`: of the largest of contact work, loss and energy change.
    """
    balance = energy_balance(run.contact_work, float(totals["loss"].sum()), run.energy_change)
    *parts, residual = map(abs, balance.values())
    return {
        "energy_residual_share": residual / max(parts) if max(parts) else 0.0,
        "bounded_share_of_time": (totals["steps_bounded"] / np.maximum(totals["steps"], 1.0)).max(),
        "melting_power": melting_power(run.problem.model, run.problem.scene.friction),
        **_so_far(run),
    }


def _so_far(run: FinishedRun) -> dict[str, Any]:
    """`numbers_so_far` of all blades the most, the heat of the whole run, and the power of the friction.

    `friction_power`: the largest mean over HEATED revolutions, or over a shorter run.
    """
    per_revolution = run.problem.choice.samples_per_revolution
    single_blades = [numbers_so_far(state, per_revolution, run.kept_revolutions) for state in run.states]
    most = {name: np.fmax.reduce([numbers[name] for numbers in single_blades]) for name in single_blades[0]}
    heat = most["heat_so_far"]
    known = np.concatenate([[0.0], heat[np.isfinite(heat)]])
    window = min(HEATED, len(known) - 1)
    powers = (known[window:] - known[: len(known) - window]) / (max(window, 1) * 2.0 * np.pi / run.problem.speed)
    return {"friction_power": powers.max(), "friction_heat": known[-1], **most}


def numbers_so_far(state: SimulationState, per_revolution: int, revolutions: int) -> dict[str, ndarray]:
    """Force, heat and bounded steps of one blade from the start to the end of each of so many revolutions.

    NaN after the end. `per_revolution`: samples. Between two marks of the totals the heat is a straight line, all else what it
    is at the later one.
    """
    samples, totals = zip((0, np.zeros((), TOTALS)), *(state.marks or [(state.samples, state.totals)]), strict=True)
    marks, values = np.array(samples) / per_revolution, np.stack(totals)
    done = np.arange(1, min(int(marks[-1]), revolutions) + 1)
    later = values[np.searchsorted(marks, done)]
    numbers = {
        "force_so_far": later["largest_force"],
        "heat_so_far": np.interp(done, marks, values["friction_heat"]),
        "bounded_so_far": later["steps_bounded"],
    }
    return {name: extended(each, revolutions) for name, each in numbers.items()}


def casing_waves(samples: ndarray, ring: RingMotion, speed: float, revolutions: int, highest_order: int) -> dict[str, ndarray]:
    """Spectrum, level and energy of each of the casing's modes in the frame that does not turn.

    `samples` (m) of q_c, then q_s, of all modes at their antinodes, in the rotor's frame, shape (samples, 2 modes), over whole
    `revolutions` at a `speed` (rad/s). A mode moves by Re(Z e^(i n theta)), Z = q_c - i q_s. The part A e^(i omega t) of Z is a
    wave that runs with the rotor, towards negative theta, where omega > 0, else against it. Returned, with the modes first:
    `casing_amplitude` (m), |A| over the signed `casing_order` omega/Omega; `casing_rms_forward` and `casing_rms_backward` (m),
    over time and circumference; `casing_energy` (J), kinetic and elastic, mean over the time:
    m/2 sum of (omega^2 + omega_n^2) |A|^2 of the modal mass m. A mode without nodal diameters runs nowhere: all of it counts as
    forward. Orders are kept up to the blade's `highest_order` and, as the casing sees these, the nodal diameters more. NaN
    among the samples stays NaN; so is a mode that is too fast for them.
    """
    count, modes = len(samples), len(ring.modes)
    nodal_diameters, own, size = ring.nodal_diameters, ring.frequencies[:modes], ring.size[:modes]
    turn = 2.0 * np.pi * revolutions * np.arange(1, count + 1) / count
    too_fast = own / speed + nodal_diameters > 0.5 * count / revolutions
    waves = (samples[:, :modes] - 1j * samples[:, modes:]).T * np.exp(1j * np.outer(nodal_diameters, turn))
    amplitudes = np.abs(np.fft.fft(np.where(too_fast[:, None], np.nan, waves))) / count
    orders = np.rint(np.fft.fftfreq(count, 1.0 / count)) / revolutions
    squares = amplitudes**2
    energy = 0.5 * np.sum(((orders * speed) ** 2 + own[:, None] ** 2) * squares, axis=1) / size**2
    forward, backward = (0.5 * squares[:, wave].sum(axis=1) for wave in (orders > 0.0, orders < 0.0))
    # Z of a mode without nodal diameters is real, or imaginary: both halves move together
    runs = nodal_diameters > 0
    forward, backward = np.where(runs, forward, 2.0 * (forward + backward)), runs * backward
    ascending = np.argsort(orders)
    shown = ascending[np.abs(orders[ascending]) <= highest_order + nodal_diameters.max()]
    return {
        "casing_nodal_diameter": nodal_diameters,
        "casing_frequency": own / 2.0 / np.pi,
        "casing_order": orders[shown],
        "casing_amplitude": amplitudes[:, shown].astype(np.float32),
        "casing_rms_forward": np.sqrt(forward),
        "casing_rms_backward": np.sqrt(backward),
        "casing_energy": energy,
    }


def fatigue_numbers(run: FinishedRun, stress: StressOperators, shown: int) -> dict[str, ndarray]:
    """Alternating stress (Pa) of all revolutions, about the mean of those in the statistic; rotation is always in the mean.

    `alternating_stress` and `mean_stress`, shape (nodes,): of one blade, that at the place `shown`, in the region that
    decides, the former the largest of all revolutions. `cycle_alternating`, `cycle_mean`, shape (pairs,), region by region, and
    `cycle_counts`, shape (regions, revolutions): those of all blades, see largest_cycles. A diverged run has NaN and no pairs.
    """
    judged = judged_operator(stress)
    if run.first_diverged is not None:
        alternating_stress = mean_stress = np.full(judged.operator.shape[1], np.nan, dtype=np.float32)
        nothing = np.empty(0, dtype=np.float32)
        pairs = len(stress) * [(nothing, nothing, np.empty(0, dtype=np.int32))]
    else:
        pairs = []
        motions = [(problem, part.snapshots) for problem, part in zip(run.problems, run.records, strict=True)]
        for operator in stress.values():
            blades = [_cycles(*motion, operator) for motion in motions]
            if operator is judged:
                alternating_stress, mean_stress = blades[shown][0].max(axis=0), blades[shown][1]
            alternating, mean = (np.concatenate(parts, axis=-1) for parts in zip(*blades, strict=True))
            pairs.append(largest_cycles(alternating, mean))
    every_alternating, every_mean, counts = zip(*pairs, strict=True)
    return {
        "alternating_stress": alternating_stress,
        "mean_stress": mean_stress,
        "cycle_alternating": np.concatenate(every_alternating),
        "cycle_mean": np.concatenate(every_mean),
        "cycle_counts": np.stack(counts),
    }


def _cycles(problem: Problem, snapshots: ndarray, stress: StressOperator) -> tuple[ndarray, ndarray]:
    """Stress of one blade in all revolutions with snapshots, of which the last ones are those of the statistic."""
    choice, model = problem.choice, problem.model
    shapes = model.to_reduced @ problem.contact.state_shapes
    rotation = rotation_amplitudes(model.rotation_stiffening, problem.speed)
    return stress_cycles(stress, snapshots, shapes, rotation, choice.snapshots_per_revolution, choice.revolutions_in_statistic)


def lining_at_tip(model: ContactModel, scene: Scene) -> dict[str, float]:
    """Numbers of OF_LINING of a blade's `model` in a lined `scene`; empty without a lining.

    `lining_elastic_stiffness` (N/m): E A/e of the lining under all contact nodes, with its modulus E, thickness e and the
    pressed area A; `lining_plastic_stiffness` (N/m): the slope while it wears, that times K/(E + K). `tip_stiffness` (N/m): of
    the blade at rest under a normal force on its tip, spread evenly along it, against the mean displacement there.
    `lined_tip_share`: width of the lining over the length of tip, both along the casing's meridian.
    """
    lining, lengths = scene.lining, model.tip_lengths
    if lining is None:
        return {}
    areas = lining.pressed_areas(lengths, model.tip_radius)
    elastic, _, plastic = lines_of_bar(lining.elastic_modulus, areas.sum(), lining)
    normal = casing_axes(model.displacement_operator, scene.casing.angle(model.tip_cone_angle))[0]
    mean_rows = lengths / lengths.sum() @ normal
    width = areas.sum() / (lining.arc(model.tip_radius) if lining.published else lining.contact_length)
    values = (elastic, plastic, 1.0 / np.sum(mean_rows**2 / model.squared_frequencies), width / lengths.sum())
    return dict(zip(OF_LINING, values, strict=True))
