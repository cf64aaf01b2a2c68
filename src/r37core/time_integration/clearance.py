"""The room of the contact nodes: the round casing's clearance at each speed, and whether a run can begin with it."""

import numpy as np
from numpy import ndarray

from r37core.contact.casing import approach
from r37core.contact.scene import Scene
from r37core.rom.contact_model import ContactModel

LARGEST_RING = 1.25
"""Radius of a casing's middle line over that of the tip."""


class NoRoomError(ValueError):
    """A tip that reaches the casing before anything vibrates."""


def clearances(model: ContactModel, scene: Scene, speeds: ndarray) -> ndarray:
    """Clearance (m) of the round casing at `speeds` (rad/s), shape (speeds, nodes).

    The casing's own, with its growth, less what rotation and a longer blade bring the node nearer to it. Raises BucklingError.
    """
    casing, nearer = scene.casing, np.zeros((len(speeds), len(model.theta)))
    if casing.centrifugal:
        nearer = growth(model, speeds, casing.angle(model.tip_cone_angle))
    return (casing.clearance + casing.opening(speeds) - casing.longer)[:, None] - nearer


def growth(model: ContactModel, speeds: ndarray, cone_angle: float) -> ndarray:
    """Distance (m) by which rotation at `speeds` (rad/s) brings the contact nodes nearer to a cone, shape (speeds, nodes).

    `cone_angle`: its half angle (rad). Raises BucklingError.
    """
    return approach(model.radius, model.displaced(speeds), cone_angle)


def check_room(model: ContactModel, scene: Scene, speeds: ndarray) -> None:
    """NoRoomError where the tip reaches the round casing; a lining in front of it is worn by `cut`.

    A run that begins inside of a rigid casing would begin with a blow that is not there: the speed was reached slowly.
    """
    room = clearances(model, scene, speeds) + scene.wear_law.thickness
    if room.min() >= 0.0:
        return
    row, node = np.unravel_index(room.argmin(), room.shape)
    lacking, lining = -room[row, node], "a thicker lining" if scene.lined else "a lining"
    raise NoRoomError(
        f"casing.clearance of the scene (scenes.yaml): at {speeds[row]:g} rad/s contact node {node + 1} of {room.shape[1]}, "
        f"from the leading edge on, is {lacking:.3g} m inside of the casing before anything vibrates; allowed: a cold_m of "
        f"at least {scene.casing.clearance + lacking:.6g} m for this speed, {lining}, a casing_growth larger by as much, or "
        "lower speeds (speeds, those of run-ups, and structure.maximum_speed_rad_s)"
    )


def check_ring(model: ContactModel, scene: Scene) -> None:
    """NoRoomError for an elastic casing whose radius is not about that of the tip: most likely another unit, or a diameter."""
    ring, tip = scene.casing.ring_radius, model.tip_radius
    if ring is None or tip <= ring <= LARGEST_RING * tip:
        return
    raise NoRoomError(
        f"casing.ring.radius_m of the scene (scenes.yaml): found {ring:g} m round a tip at {tip:.4g} m; "
        f"allowed: {tip:.4g} to {LARGEST_RING * tip:.4g} m"
    )
