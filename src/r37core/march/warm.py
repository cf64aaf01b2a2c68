"""Compiling the march ahead of use."""

from __future__ import annotations

import numpy as np

from r37core.contact.casing import Casing
from r37core.contact.scene import Friction, Lining, Scene
from r37core.rom.contact_model import ContactModel

from .choice import MarchChoice
from .simulate import March


def warm_kernel(lining: bool, friction: bool, exact_gap: bool, stress: bool, energy: bool) -> None:
    """Run a blade of three modes for one revolution, so that numba compiles and caches what such a scene needs."""
    scene = Scene(
        Casing(1e-4),
        Lining(5e-3, 1e9, 1e9, 1.0) if lining else None,
        Friction(0.1) if friction else None,
        exact_gap=exact_gap,
    )
    toy = ContactModel(
        squared_frequencies=np.array([1.0e6, 4.0e6, 9.0e6]),
        stiffness_per_square=np.zeros((3, 3)),
        rows=1e-3 * np.ones((3, 2, 3)),
        radius=np.array([0.25, 0.25]),
        theta=np.array([-0.1, 0.1]),
        chord_share=0.01,
        tip_rows=1e-3 * np.ones((2, 3, 3)),
        to_reduced=np.eye(3),
    )
    choice = MarchChoice(1e-4, 1, 8, snapshots_per_revolution=4 * stress, snapshot_revolutions=1, energy=energy)
    march = March(toy, 1000.0, scene, choice)
    march.advance(march.start(), 1)
