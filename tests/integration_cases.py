"""Scenes and models that the tests of the time integration share."""

import hashlib
import platform
from dataclasses import replace

import numpy as np
from defaults import Casing, Friction, IntegrationChoice, Lining, Scene

from r37core.contact.ring import Ring
from r37core.contact.scene import Rotor
from r37core.machine_code import native
from r37core.rom.contact_model import ContactModel
from r37core.time_integration.integrators import EXACT_MODAL
from r37core.time_integration.rotor_simulation import RotorSimulation
from r37core.time_integration.simulate import Simulation

FUSED = platform.machine() != "x86_64" or "+fma" in native.processor()[1]
"""Whether this processor rounds a product and what is added to it once."""

LINING = Lining(5e-3, 20e9, 5e9, 1.5, bar_width=0.03)
AT_ONCE = Casing(0.356e-3, rise_fraction=0.0)
ABRADABLE = Scene(AT_ONCE, LINING, Friction(0.15))
DIRECT = Scene(AT_ONCE, None, Friction(0.15))
NARROW = replace(ABRADABLE, lining=replace(LINING, bar_width=1e-3))
SCENES = {
    "direct": DIRECT,
    "direct_constant": replace(DIRECT, friction=Friction(0.15, vector=False)),
    "direct_exact": replace(DIRECT, exact_gap=True),
    "abradable": ABRADABLE,
    "abradable_constant": replace(ABRADABLE, friction=Friction(0.15, vector=False)),
    "abradable_exact": replace(ABRADABLE, exact_gap=True),
    "thin_lining": replace(ABRADABLE, lining=Lining(1e-4, 1e8, 5e7, 1e5, bar_width=0.03)),
}

ELASTIC = Lining(5e-3, 20e9, 5e9, 1e30, bar_area=1e-6)
"""Bars that never yield."""

RING = Ring(0.255, 0.002, 0.05, 2.1e11, 7850.0, 0.002, 1e7, 1e6, 11)
"""Of steel, with eleven modes: more pairs than a vector has numbers."""


def model_of_node(rows, frequencies, radius=0.25, tip_cone_angle=0.0, per_square=0.0):
    """One node, which is the whole tip, moved by modes of these frequencies (rad/s): its rows have shape (3, modes).

    `per_square`: change of every mode's stiffness per squared speed.
    """
    rows, modes = np.array(rows, dtype=float)[:, None], len(frequencies)
    return ContactModel(
        squared_frequencies=np.array(frequencies, dtype=float) ** 2,
        stiffness_per_square=per_square * np.eye(modes),
        displacement_operator=rows,
        radius=np.array([radius]),
        theta=np.array([0.0]),
        tip_lengths=np.array([0.03]),
        tip_cone_angle=tip_cone_angle,
        tip_displacement_operator=np.repeat(rows, 2, axis=1),
        to_reduced=np.eye(modes),
        rotation_shapes=np.zeros((3, 1, 1)),
        rotation_stiffening=np.zeros(1),
    )


def oscillator(frequency, radius=0.25):
    """One mode whose amplitude is the radial displacement of one node."""
    return model_of_node([[1.0], [0.0], [0.0]], [frequency], radius)


def random_model(nodes, modes=None):
    """A blade of so many contact nodes on a cone, each moving on its own."""
    generator = np.random.default_rng(nodes)
    modes = modes or max(nodes, 8) + 16
    frequencies = np.sort(generator.uniform(5e3, 3e6, modes))
    return ContactModel(
        squared_frequencies=frequencies**2,
        stiffness_per_square=np.zeros((modes, modes)),
        displacement_operator=generator.standard_normal((3, nodes, modes)) * [[[1.0]], [[0.5]], [[0.5]]] * 3.0,
        radius=np.linspace(0.252, 0.245, nodes),
        theta=np.linspace(0.1, -0.05, nodes),
        tip_lengths=np.full(nodes, 0.03 / nodes),
        tip_cone_angle=-0.26,
        tip_displacement_operator=generator.standard_normal((3, 2, modes)),
        to_reduced=np.eye(modes),
        rotation_shapes=np.zeros((3, nodes, 1)),
        rotation_stiffening=np.zeros(1),
    )


def with_static_modes(model, flexibility, frequency=1e8):
    """The model with three modes more for each contact node, which move it alone, one in each direction.

    They are faster (rad/s) than any step follows, and so displace the node at once by its `flexibility` (m/N) times the force
    on it.
    """
    directions, nodes, _ = model.displacement_operator.shape
    more = directions * nodes
    return with_modes(model, frequency, np.sqrt(flexibility) * np.eye(more).reshape(directions, nodes, more))


def with_modes(model, frequency, rows):
    """The model with modes more of one frequency (rad/s), which under a static force move the nodes by `rows` (m/N^0.5).

    The tip and the reduced coordinates have none of that: samples and stress show the modes that the model had.
    """
    more = rows.shape[-1]

    def last_axis(array):
        return np.pad(array, [(0, 0)] * (array.ndim - 1) + [(0, more)])

    return replace(
        model,
        squared_frequencies=np.append(model.squared_frequencies, np.full(more, frequency**2)),
        stiffness_per_square=np.pad(model.stiffness_per_square, (0, more)),
        displacement_operator=np.concatenate([model.displacement_operator, frequency * rows], axis=-1),
        tip_displacement_operator=last_axis(model.tip_displacement_operator),
        to_reduced=last_axis(model.to_reduced),
    )


def bits_of_programs():
    """SHA-256 of samples, totals and wear of runs that share a program: name of the run -> digits."""
    blade, ring = with_static_modes(random_model(8), 1e-9), replace(AT_ONCE, ring=RING.modes())
    choice = IntegrationChoice(2e-7, 2, 31, integrator=EXACT_MODAL)
    scenes = {"lined": ABRADABLE, "direct": DIRECT, "elastic ring": replace(ABRADABLE, casing=ring)}
    bits = {}
    for name, scene in scenes.items():
        simulation = Simulation(blade, 12_000.0, scene, choice)
        state = simulation.start()
        bits[name] = _hash_of([simulation.advance(state, choice.revolutions)], [state])
    blades = Rotor((1, 2), (0.0, np.pi), (1.0, 1.0), (0.0, 0.0), True)
    run = RotorSimulation(blade, 12_000.0, Scene(ring, LINING, Friction(0.15), rotor=blades), choice).run()
    return bits | {"rotor in an elastic casing": _hash_of(run.records, run.states)}


def _hash_of(records, states):
    digest = hashlib.sha256()
    for record, state in zip(records, states, strict=True):
        assert state.totals["steps_in_contact"] > 100
        for array in (record.samples, state.totals, state.wear):
            digest.update(b"" if array is None else array.tobytes())
    return digest.hexdigest()
