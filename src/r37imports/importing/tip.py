"""The tip of an imported blade: whether casing contact and rotation make sense there, its edges and its camber line."""

import numpy as np
from scipy.spatial import cKDTree

from r37core.blade.sense import LEAST, TipSense, sense_of_line
from r37core.fem.surface import Faces, area_vectors, loops, nodes_of, smooth_patches
from r37core.rom.recovery_nodes import cylinder
from r37imports.placement import in_degrees, refuse_sense
from r37imports.refusal import ImportRefused, warn_of

_CORNER = np.cos(np.radians(40.0))
_NEAR_END = 1.2  # mean thicknesses of the tip: a corner this near to the farthest point ends the edge's line
_NEAR_CAMBER = 0.3  # of the local thickness: tip nodes that count as on the camber line
_STEPS = np.linspace(0.0, 1.0, 201)  # fractions of the edges at which they are compared
_DOWNSTREAM = 0.02  # of the chord: how far the trailing edge lies downstream at least

TipLines = dict[str, tuple[np.ndarray, np.ndarray]]
"""Name of a node set along the tip -> nodes from leading to trailing edge, fraction of the line's length of each."""


def check_revolution(points: np.ndarray, tolerance: float) -> None:
    """Refuse a tip, nodes `points`, shape (n, 3), farther than `tolerance` (m) from every surface of revolution about z."""
    off = off_revolution(points)
    worst = np.argmax(np.abs(off))
    if abs(off[worst]) > tolerance:
        raise ImportRefused(
            f"tip: no surface of revolution about the rotor axis: at z = {points[worst, 2]:.5g} m the radius "
            f"{np.hypot(*points[worst, :2]):.6g} m is {1e3 * off[worst]:+.3g} mm off the meridian through all its nodes "
            f"(allowed: revolution_tolerance_m, {1e3 * tolerance:g} mm); turn the tip to the casing's shape, or check "
            "rotor_axis and the rule for the tip"
        )


def off_revolution(points: np.ndarray) -> np.ndarray:
    """Difference (m) of the radius of `points`, shape (n, 3), from the meridian through all of them, shape (n,).

    The meridian is fitted: radius as a parabola of z, a constant where the points have no axial length.
    """
    radius, _, z = cylinder(points)
    size = np.ptp(points, axis=0).max()
    degree = min(2, len(np.unique(np.round(z / (1e-3 * size)))) - 1) if np.ptp(z) > 0.02 * size else 0
    return radius - np.polynomial.Polynomial.fit(z, radius, degree)(z)


def check_order(points: np.ndarray) -> None:
    """Refuse contact nodes `points`, shape (n, 3), that do not run from the leading to the trailing edge, downstream.

    Each node must lie farther along the straight line from the first to the last than the one before it.
    """
    if len(points) < 2:
        return
    chord = points[-1] - points[0]
    back = np.diff(points, axis=0) @ chord <= 0.0
    if back.any():
        raise ImportRefused(
            f"contact node {np.argmax(back) + 2} does not lie beyond the one before it on the way from the first to the last; "
            "list them in their order along the tip, from the leading to the trailing edge"
        )
    _check_downstream(chord)


def _check_downstream(chord: np.ndarray) -> None:
    """Refuse a `chord`, from leading to trailing edge, that does not point downstream."""
    share = chord[2] / np.linalg.norm(chord)
    if share < -_DOWNSTREAM:
        raise ImportRefused(
            "the contact nodes run upstream; list them from the leading to the trailing edge, or check whether rotor_axis "
            "points downstream"
        )
    if share < _DOWNSTREAM:
        raise ImportRefused(
            "tip: leading and trailing edge lie at the same z, so that they cannot be told apart; check rotor_axis"
        )


def check_sense(points: np.ndarray, lines: TipLines, pressure_forward: bool) -> None:
    """Refuse a rotation, rotor axis or pressure side that the tip's `lines` of nodes at `points` contradict.

    `points`: shape (nodes, 3), in the blade's frame; `pressure_forward`: whether the pressure side looks along the rotation.
    What the tip does not tell is warned of.
    """
    sides = [_section_at(points[lines[name][0]], _STEPS) for name in ("tip_pressure_edge", "tip_suction_edge")]
    sense = sense_of_line(0.5 * (sides[0] + sides[1]))
    refuse_sense(sides[0][[0, -1]], sense, pressure_forward)
    _warn_of_stagger(sense)
    if sense.fits(pressure_forward) is None:
        _warn_unproved("pressure_side", f"the tip's camber of {in_degrees(sense.camber)}")


def check_sense_of_nodes(points: np.ndarray) -> None:
    """Refuse a rotation that the contact nodes contradict; `points`, shape (n, 3), are in order and in the blade's frame.

    Only their stagger tells: on one side of the blade their line has not the blade's camber. A single node is warned of.
    """
    if len(points) == 1:
        _warn_unproved("rotation", "the stagger of a single contact node")
    else:
        sense = sense_of_line(ends := points[[0, -1]])
        refuse_sense(ends, sense, None)
        _warn_of_stagger(sense)


def _warn_of_stagger(sense: TipSense) -> None:
    if sense.leads() is None:
        _warn_unproved("rotation", f"the tip's stagger of {in_degrees(sense.stagger)}")


def _warn_unproved(key: str, shown: str) -> None:
    warn_of(
        f"{key} is taken as given: {shown} does not prove it ({np.degrees(LEAST):g} degrees would). Make sure of it"
        + (": with a wrong one a blade looks safe that is not" if key == "rotation" else "")
    )


def find_tip_lines(points: np.ndarray, faces: list[Faces], pressure_forward: bool) -> TipLines:
    """Lines along the tip `faces` of a blade with nodes at `points`, shape (nodes, 3), in the blade's frame.

    Leading and trailing edge are the two points of the tip's outline that are farthest apart, the leading one upstream; the
    edges end at sharp corners near them (blunt edges). `pressure_forward`: whether the pressure side looks towards the
    rotation (compressors), against growing theta. The camber line is made of the tip's nodes that lie half-way between the
    two edges. Raises ImportRefused where that cannot be decided.
    """
    # any crease: whatever shares edges
    count = int(smooth_patches(faces, area_vectors(faces, points), np.pi).max(initial=-1)) + 1
    if count > 1:
        raise ImportRefused(f"tip: its faces are {count} patches that do not touch; allowed: one")
    outlines = loops(faces)
    outline = max(outlines, key=lambda loop: arc_length(points[np.append(loop, loop[0])])[-1])
    distance = np.linalg.norm(points[outline][:, None] - points[outline], axis=2)
    first, last = np.unravel_index(np.argmax(distance), distance.shape)
    if points[outline[first], 2] > points[outline[last], 2]:
        first, last = last, first
    chord = points[outline[last]] - points[outline[first]]
    _check_downstream(chord)
    forth = np.roll(outline, -first)[: (last - first) % len(outline) + 1]
    back = np.roll(outline, -last)[: (first - last) % len(outline) + 1][::-1]
    spokes = points[outline] - points[outline].mean(axis=0)
    area = 0.5 * np.linalg.norm(np.sum(np.cross(spokes, np.roll(spokes, -1, axis=0)), axis=0))
    sides = [_between_corners(points, line, float(area / np.linalg.norm(chord))) for line in (forth, back)]
    sides.sort(key=lambda line: _middle_angle(points, line), reverse=not pressure_forward)
    pressure, suction = sides
    lines = {"tip_pressure_edge": pressure, "tip_suction_edge": suction}
    camber = _camber(points, nodes_of(faces), pressure, suction)
    return {name: (line, fractions_along(points[line])) for name, line in lines.items()} | {"tip_camber_line": camber}


def _camber(points: np.ndarray, tip: np.ndarray, pressure: np.ndarray, suction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tip nodes near the line half-way between the edges, and their fractions along it."""
    sides = [_section_at(points[line], _STEPS) for line in (pressure, suction)]
    middle, across = 0.5 * (sides[0] + sides[1]), np.linalg.norm(sides[1] - sides[0], axis=1)
    distance, nearest = cKDTree(middle).query(points[tip])
    spacing = np.linalg.norm(np.diff(middle, axis=0), axis=1).max()
    near = distance <= np.maximum(_NEAR_CAMBER * across[nearest], 0.5 * spacing)
    if near.sum() < 2:
        # one element of first order across the tip has no nodes there
        return pressure, fractions_along(points[pressure])
    order = np.argsort(nearest[near], kind="stable")
    return tip[near][order], _STEPS[nearest[near]][order]


def _between_corners(points: np.ndarray, line: np.ndarray, thickness: float) -> np.ndarray:
    """The line without the ends beyond sharp corners: a blunt edge is no part of the sides."""
    path = points[line]
    step = np.diff(path, axis=0)
    step /= np.linalg.norm(step, axis=1)[:, None]
    sharp = np.flatnonzero(np.sum(step[1:] * step[:-1], axis=1) < _CORNER) + 1
    length = arc_length(path)
    reach = min(_NEAR_END * thickness, 0.25 * length[-1])
    start = max(sharp[length[sharp] <= reach], default=0)
    end = min(sharp[length[-1] - length[sharp] <= reach], default=len(line) - 1)
    return line[start : end + 1]


def _middle_angle(points: np.ndarray, line: np.ndarray) -> float:
    return cylinder(_section_at(points[line], np.linspace(0.3, 0.7, 9)))[1].mean()


def arc_length(path: np.ndarray) -> np.ndarray:
    """Length along a path up to each of its points, shape (points,), of points of shape (points, 3)."""
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])


def fractions_along(path: np.ndarray) -> np.ndarray:
    """Fractions of a path's length up to each of its points, of shape (points, 3); a half for a single one."""
    length = arc_length(path)
    return length / length[-1] if length[-1] > 0.0 else np.full(len(path), 0.5)


def _section_at(path: np.ndarray, fractions: np.ndarray) -> np.ndarray:
    """Points at fractions of the path's length, shape (fractions, 3)."""
    own = fractions_along(path)
    return np.stack([np.interp(fractions, own, column) for column in path.T], axis=1)
