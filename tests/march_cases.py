"""Scenes and a model that the tests of the march share."""

import numpy as np

from r37core.contact.casing import Casing
from r37core.contact.scene import Friction, Lining, Scene
from r37core.rom.contact_model import ContactModel

LINING = Lining(5e-3, 20e9, 5e9, 1.5, bar_width=0.03)
AT_ONCE = Casing(0.356e-3, rise_fraction=0.0)
ABRADABLE = Scene(AT_ONCE, LINING, Friction(0.15))
DIRECT = Scene(AT_ONCE, None, Friction(0.15))


def oscillator(frequency, radius=0.25):
    """One mode whose amplitude is the radial displacement of one node."""
    return ContactModel(
        squared_frequencies=np.array([frequency**2]),
        stiffness_per_square=np.zeros((1, 1)),
        rows=np.array([[[1.0]], [[0.0]], [[0.0]]]),
        radius=np.array([radius]),
        theta=np.array([0.0]),
        tip_cone_angle=0.0,
        tip_rows=np.array([[[1.0], [1.0]], [[0.0], [0.0]], [[0.0], [0.0]]]),
        to_reduced=np.eye(1),
    )
