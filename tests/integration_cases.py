"""Scenes and a model that the tests of the time integration share."""

import numpy as np
import pytest
from defaults import Casing, Friction, Lining, Scene

from r37core.rom.contact_model import ContactModel

LINING = Lining(5e-3, 20e9, 5e9, 1.5, bar_width=0.03)
AT_ONCE = Casing(0.356e-3, rise_fraction=0.0)
ABRADABLE = Scene(AT_ONCE, LINING, Friction(0.15))
DIRECT = Scene(AT_ONCE, None, Friction(0.15))


def held(nodes):
    """Contact nodes that rotation leaves where they are."""
    return {"rotation_shapes": np.zeros((3, nodes, 1)), "rotation_stiffening": np.zeros(1)}


def oscillator(frequency, radius=0.25):
    """One mode whose amplitude is the radial displacement of one node."""
    return ContactModel(
        squared_frequencies=np.array([frequency**2]),
        stiffness_per_square=np.zeros((1, 1)),
        displacement_operator=np.array([[[1.0]], [[0.0]], [[0.0]]]),
        radius=np.array([radius]),
        theta=np.array([0.0]),
        tip_cone_angle=0.0,
        tip_displacement_operator=np.array([[[1.0], [1.0]], [[0.0], [0.0]], [[0.0], [0.0]]]),
        to_reduced=np.eye(1),
        **held(1),
    )


def random_model(nodes):
    """A blade of so many contact nodes on a cone, each moving on its own."""
    generator = np.random.default_rng(nodes)
    modes = max(nodes, 8) + 16
    frequencies = np.sort(generator.uniform(5e3, 3e6, modes))
    return ContactModel(
        squared_frequencies=frequencies**2,
        stiffness_per_square=np.zeros((modes, modes)),
        displacement_operator=generator.standard_normal((3, nodes, modes)) * [[[1.0]], [[0.5]], [[0.5]]] * 3.0,
        radius=np.linspace(0.252, 0.245, nodes),
        theta=np.linspace(0.1, -0.05, nodes),
        tip_cone_angle=-0.26,
        tip_displacement_operator=generator.standard_normal((3, 2, modes)),
        to_reduced=np.eye(modes),
        **held(nodes),
    )


def assert_same_totals_and_wear(ours, theirs):
    """Of the states that two engines leave."""
    for total in ("steps", "steps_in_contact", "casing_hits"):
        assert ours.totals[total] == theirs.totals[total]
    for total in ("largest_force", "work", "loss"):
        assert ours.totals[total] == pytest.approx(theirs.totals[total], rel=1e-8)
    if ours.wear is not None:
        np.testing.assert_allclose(ours.wear, theirs.wear, rtol=0, atol=1e-10 * theirs.wear.max())
