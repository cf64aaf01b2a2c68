"""The round casing's clearance at each contact node and speed, and whether a run can begin with it."""

from __future__ import annotations

import numpy as np

from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel


class NoRoomError(ValueError):
    """A tip that reaches the casing before anything vibrates."""


def clearances(model: ContactModel, scene: Scene, speeds: np.ndarray) -> np.ndarray:
    """Clearance (m) of the round casing at `speeds` (rad/s), shape (speeds, nodes).

    The casing's own, with its growth, less what rotation brings the node nearer to it. Raises BucklingError.
    """
    casing = scene.casing
    undeformed = np.repeat((casing.clearance + casing.opening(speeds))[:, None], len(model.theta), axis=1)
    return undeformed - model.growth(speeds, casing.angle(model.tip_cone_angle)) if casing.centrifugal else undeformed


def check_room(model: ContactModel, scene: Scene, speeds: np.ndarray) -> None:
    """NoRoomError where the tip reaches the round casing; through a lining in front of it the tip cuts its way.

    A run that begins inside of a rigid casing would begin with a blow that is not there: the speed was reached slowly.
    """
    room = clearances(model, scene, speeds) + (scene.lining.thickness if scene.lining else 0.0)
    if room.min() >= 0.0:
        return
    row, node = np.unravel_index(room.argmin(), room.shape)
    raise NoRoomError(
        f"casing.clearance: at {speeds[row]:g} rad/s contact node {node + 1} of {room.shape[1]} from the leading edge "
        f"is {-room[row, node]:.3g} m inside of the casing at rest; allowed: a cold_m of at least "
        f"{scene.casing.clearance - room[row, node]:.6g} m for this speed, a lining, a casing that grows more, or lower speeds "
        "(speeds, run_ups, and structure.maximum_speed_rad_s)"
    )
