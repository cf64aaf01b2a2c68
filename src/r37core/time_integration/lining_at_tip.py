"""Stiffness of the lining that a whole tip presses, next to that of the tip itself."""

import numpy as np

from r37core.contact.casing import casing_axes
from r37core.contact.laws import lines_of_bar
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel

from .speed_arrays import OF_LINING


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
