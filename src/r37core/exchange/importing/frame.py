"""Where each node of an imported mesh lies on the blade: chord, span, thickness and normal, from its shape alone."""

import numpy as np
from scipy.spatial import cKDTree

from r37core.exchange.refusal import ImportRefused

_SECTIONS = 25
_SHARE = 0.06  # of the span: nodes within it make a section
_FEWEST = 24  # nodes of a section


def blade_parameters(
    points: np.ndarray, root: np.ndarray, tip: np.ndarray, pressure_forward: bool
) -> tuple[np.ndarray, np.ndarray]:
    """(chord, span, thickness) of every node, shape (nodes, 3), and unit normals, shape (nodes, 3).

    `points` (m), shape (nodes, 3), in the blade's frame; `root` and `tip`: node numbers. Span is the distance to the root
    over that to root and tip. Each section (nodes of like span) has a chord, the longest principal axis of its nodes across
    the blade's height, pointing downstream, and a normal, the shortest, from the pressure to the suction side; chord and
    thickness are the place between the section's extremes along them. They serve the names of the modes and pictures; of the
    mechanics only the weights of patches, along the chord. `pressure_forward`: whether the pressure side looks towards the
    rotation. Raises ImportRefused for a mesh with too few nodes for sections.
    """
    root_distance, _ = cKDTree(points[root]).query(points)
    tip_distance, _ = cKDTree(points[tip]).query(points)
    span = root_distance / (root_distance + tip_distance)
    levels = np.linspace(0.0, 1.0, _SECTIONS)
    members = [_members(span, level) for level in levels]
    centres = np.array([0.5 * (points[m].max(axis=0) + points[m].min(axis=0)) for m in members])
    height = np.gradient(centres, levels, axis=0)
    if not np.linalg.norm(centres[-1] - centres[0]) > 1e-6 * np.ptp(points, axis=0).max():
        raise ImportRefused(
            f"found a mesh of {len(points)} nodes, too few to tell sections between root and tip; mesh the blade finer"
        )
    # a coarse mesh has the same nodes in neighbouring sections
    height[np.linalg.norm(height, axis=1) < 0.2 * np.linalg.norm(centres[-1] - centres[0])] = centres[-1] - centres[0]
    height /= np.linalg.norm(height, axis=1)[:, None]
    chords, normals = _section_axes(points, members, centres, height, pressure_forward)
    extremes = []
    for m, centre, chord, normal in zip(members, centres, chords, normals, strict=True):
        along, across = (points[m] - centre) @ chord, (points[m] - centre) @ normal
        extremes.append([along.min(), np.ptp(along), across.min(), np.ptp(across)])
    columns = np.hstack([centres, chords, normals, extremes]).T
    rows = np.stack([np.interp(span, levels, column) for column in columns], axis=1)
    centre, chord, normal, sizes = np.split(rows, [3, 6, 9], axis=1)
    along_low, along_size, across_low, across_size = sizes.T
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    chord_fraction = (np.sum((points - centre) * chord, axis=1) - along_low) / along_size
    thickness = 2.0 * (np.sum((points - centre) * normal, axis=1) - across_low) / across_size - 1.0
    return np.stack([np.clip(chord_fraction, 0.0, 1.0), span, np.clip(thickness, -1.0, 1.0)], axis=1), normal


def _members(span: np.ndarray, level: float) -> np.ndarray:
    distance = np.abs(span - level)
    within = np.flatnonzero(distance <= _SHARE)
    return within if len(within) >= _FEWEST else np.argsort(distance, kind="stable")[:_FEWEST]


def _section_axes(
    points: np.ndarray, members: list[np.ndarray], centres: np.ndarray, height: np.ndarray, pressure_forward: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors along the chord and the normal of every section, shape (sections, 3) each; signs agree along the span."""
    chords, normals = [], []
    for m, centre, up in zip(members, centres, height, strict=True):
        flat = points[m] - points[m].mean(axis=0)
        flat -= np.outer(flat @ up, up)
        _, axes = np.linalg.eigh(flat.T @ flat)
        chord, normal = axes[:, 2], axes[:, 1]
        theta = np.array([-centre[1], centre[0], 0.0]) / np.hypot(centre[0], centre[1])
        towards_suction = theta if pressure_forward else -theta
        chords.append(chord * np.sign(chord[2] if abs(chord[2]) > 0.02 else chord @ towards_suction))
        normals.append(normal * np.sign(normal @ towards_suction))
    for series in (chords, normals):
        for i in range(1, len(series)):
            series[i] *= 1.0 if series[i] @ series[i - 1] >= 0.0 else -1.0
    return np.array(chords), np.array(normals)
