"""Mesh of a sector of a disc under a blade's root: columns of elements below the faces of the root and those round it.

gmsh meshes the top of the rim in the plane (R theta, z), R the mean radius of the root, round the faces of the root. Its cut
sides follow the root's stagger, and one is the other moved by a pitch. Each face of this plane is a column of layers in the
rim: bricks below quadrangles, wedges below triangles. Columns between two lines across the root go on through the web to the
bore. These lines straighten within the rim, so the web is plane. Blade and disc share the nodes of the root.
"""

from dataclasses import replace
from itertools import chain, pairwise

import gmsh
import numpy as np
from numpy import ndarray

from r37core.blade.profile import BladeShapeError
from r37core.mesh.blade_mesh import BladeMesh
from r37core.mesh.disc import OVERHANG, Disc
from r37core.mesh.generate import quiet_gmsh

from .surface import chosen, mask_within, outer_faces

_TOP, _RIM, _WEB = 2.5, 1.5, 5.0
"""Sizes of the elements on the top, of layers of the rim and of the web, in steps of the root's elements along the axis."""

_CAP = 2.0
"""Height of the triangle before a rounded edge of the root, in its widths: a wider one would be inside out there."""

_FREE = 0.9
"""Share of a pitch that the root may take."""

_TRIANGLE6 = 9


class _Root:
    """The root in the plane of the top: `y` (R theta, m) and `z` of its nodes, and how the sector lies round it.

    `rows`: nodes of each line across the root from the leading to the trailing edge, corners and mid-nodes in turn;
    `stations`: rows above the sides of the web; `sides`, shape (2, 4, 2): points of the cut sides; `step` (m): of rows.
    """

    def __init__(self, blade: BladeMesh, disc: Disc, location: str):
        self.nodes = blade.node_set("root")
        x, y, self.z = blade.points[self.nodes].T
        self.radius = np.hypot(x, y)
        self.mean_radius = self.radius.mean()
        self.y, self.pitch = self.mean_radius * np.arctan2(y, x), 2.0 * np.pi * self.mean_radius / disc.sectors
        self.hub, self.stagger = (np.polynomial.Polynomial.fit(self.z, part, n) for part, n in ((self.radius, 2), (self.y, 1)))
        across, width, first = self.y - self.stagger(self.z), np.ptp(self.z), self.z.min()
        limits = self.radius.min() - disc.rim, width, int(_FREE * disc.sectors * self.pitch / np.ptp(across))
        if disc.bore_radius >= limits[0] or disc.web > width or disc.sectors > limits[2]:
            raise BladeShapeError(
                f"{location}: found bore_radius_m {disc.bore_radius:g}, web_m {disc.web:g} and {disc.sectors} sectors; allowed "
                "under this root: bore_radius_m below {:.4g}, web_m at most {:.4g}, at most {} sectors".format(*limits)
            )
        self.middle = 0.5 * (across.min() + across.max())
        heights = first + width * np.array([-OVERHANG, 0.5, 0.5, 1.0 + OVERHANG]) + 0.5 * disc.web * np.array([0, -1, 1, 0])
        self.heights, shift = heights, self.middle + self.stagger(heights)
        self.sides = np.array([np.stack([shift + part * self.pitch, heights], axis=1) for part in (-0.5, 0.5)])
        # chords are equal but for rounding
        chord, _, thickness = np.round(blade.parameters[self.nodes], 9).T
        order = np.lexsort((thickness * np.sign(thickness @ across), chord))
        self.rows = np.split(order, np.flatnonzero(np.diff(chord[order])) + 1)
        places, last = np.array([self.z[row].mean() for row in self.rows[::2]]), len(self.rows) // 2
        begin = int(np.clip(np.abs(places - heights[1]).argmin(), 1, last - 2))
        self.stations = begin, int(np.clip(np.abs(places - heights[2]).argmin(), begin + 1, last - 1))
        self.step = width / last
        surface = outer_faces(blade.blocks)
        (faces,) = chosen(surface, mask_within(surface, blade.mask("root")))
        self.faces = np.searchsorted(self.nodes, faces.nodes)
        low, high = (chord[self.rows[2 * station][0]] for station in self.stations)
        self.above_web = np.abs(chord[self.faces].mean(axis=1) - 0.5 * (low + high)) < 0.5 * (high - low)

    def straightened(self, places: ndarray) -> ndarray:
        """z of places, shape (n, 2), at the bottom of the rim, where the lines above the web's sides are straight."""
        across, half = places[:, 0] - self.stagger(places[:, 1]) - self.middle, 0.5 * self.pitch
        bent = []
        for station, height in zip(self.stations, self.heights[1:3], strict=True):
            row = self.rows[2 * station]
            known = (self.y - self.stagger(self.z) - self.middle)[row]
            bent.append(np.interp(across, [-half, *known, half], [height, *self.z[row], height]))
        first, *web, last = self.heights
        return np.array(
            [np.interp(z, [first, *own, last], [first, *web, last]) for z, *own in zip(places[:, 1], *bent, strict=True)]
        )


def mesh_disc(blade: BladeMesh, disc: Disc, location: str = "disc") -> BladeMesh:
    """The blade on a sector of the disc, clamped at its bore.

    Raises BladeShapeError, after the `location` of the disc's keys, where it does not fit.
    """
    root = _Root(blade, disc, location)
    places, faces, sides = _mesh_top(root)
    count, fixed = len(places), len(root.nodes)
    y, z = places.T
    radius, bottom = np.concatenate([root.radius, root.hub(z[fixed:])]), root.straightened(places)
    rim = max(1, round(disc.rim / (_RIM * root.step)))
    web = max(2, round((root.mean_radius - disc.rim - disc.bore_radius) / (_WEB * root.step)))
    # nodes by level and place, two levels to a layer
    elements = {}
    for kind, (nodes, above_web) in faces.items():
        layers = [nodes + 2 * count * layer for layer in range(rim)]
        layers += [nodes[above_web] + 2 * count * layer for layer in range(rim, rim + web)]
        corners, middles = np.split(np.concatenate(layers), 2, axis=1)
        below = corners + 2 * count, corners, middles + 2 * count, middles, corners + count
        elements[kind] = np.hstack(below)
    used = np.unique(np.concatenate([nodes.ravel() for nodes in elements.values()]))
    # the root's nodes come first, and are the blade's
    number, own = np.zeros(used[-1] + 1, dtype=np.int64), used[fixed:]
    number[:fixed], number[own] = root.nodes, len(blade.points) + np.arange(len(own))
    level, place = np.divmod(own, count)
    through_rim, through_web = np.minimum(level / (2 * rim), 1.0), np.maximum(level / 2 - rim, 0.0) / web
    height = z[place] + through_rim * (bottom - z)[place]
    distance = (radius - root.hub(z))[place] + root.hub(height) - through_rim * disc.rim
    distance += through_web * (disc.bore_radius - distance)
    angle = y[place] / root.mean_radius
    points = np.stack([distance * np.cos(angle), distance * np.sin(angle), height], axis=1)
    pairs = (np.arange(2 * (rim + web) + 1)[:, None, None] * count + sides).reshape(-1, 2)
    return replace(
        blade,
        points=np.concatenate([blade.points, points]),
        blocks={k: np.concatenate([blade.blocks.get(k, nodes[:0]), number[nodes]]) for k, nodes in elements.items()},
        parameters=np.concatenate([blade.parameters, np.tile([0.5, 0.0, 0.0], (len(own), 1))]),
        normals=np.concatenate([blade.normals, np.tile([0.0, 1.0, 0.0], (len(own), 1))]),
        node_sets={**blade.node_sets, "root": number[own[level == 2 * (rim + web)]]},
        cyclic=number[pairs[np.isin(pairs, used).all(axis=1)]],
    )


def _mesh_top(root: _Root) -> tuple[ndarray, dict[str, tuple[ndarray, ndarray]], ndarray]:
    """Places of the top's nodes, shape (nodes, 2), the root's first; its faces, by elements below, and which are above the web.

    Faces have corners and then mid-nodes, shape (faces, 6 or 8). Last the nodes of the low cut side and of the high one, shape
    (pairs, 2). Edges of the root, and the two lines above the web's sides, are edges of faces.
    """
    rows, geo, mesh, own = root.rows, gmsh.model.geo, gmsh.model.mesh, np.stack([root.y, root.z], axis=1)
    low, high = (np.array([row[end] for row in rows]) for end in (0, -1))
    # once round the root: corners and mid-nodes in turn
    round_root = np.concatenate([low[:-1], rows[-1][:-1], high[:0:-1], rows[0][:0:-1]])
    total, along = len(round_root) // 2, len(rows) // 2
    across = total // 2 - along
    with quiet_gmsh():
        points = [geo.addPoint(*place, 0.0) for place in own[round_root[::2]]]
        lines = [geo.addLine(*ends) for ends in zip(points, points[1:] + points[:1], strict=True)]
        ring, loops = [[line] for line in lines], []
        for k in (*range(along, along + across), *range(total - across, total)):
            start, end = own[round_root[[2 * k, 2 * k + 2 - 2 * total]]]
            ahead = np.array([start[1] - end[1], end[0] - start[0]])
            reach = min(_CAP, 0.5 * OVERHANG * np.ptp(root.z) / np.hypot(*ahead))
            top = geo.addPoint(*(0.5 * (start + end) + reach * ahead), 0.0)
            ring[k] = [geo.addLine(points[k], top), geo.addLine(top, points[k + 1 - total])]
            loops.append([lines[k], *ring[k]])
        sides = [[geo.addPoint(*place, 0.0) for place in side] for side in root.sides]
        edges = [[geo.addLine(*ends) for ends in pairwise(side)] for side in sides]
        ends = [geo.addLine(sides[0][place], sides[1][place]) for place in (0, 3)]
        (begin, end), (back, front) = root.stations, (2 * along + across - station for station in reversed(root.stations))
        links = [
            [geo.addLine(points[corner], side[place]) for corner, side in zip(corners, sides, strict=True)]
            for place, corners in ((1, (begin, front)), (2, (end, back)))
        ]
        loops += [
            [edges[0][0], ends[0], edges[1][0], *links[0], *chain(*ring[front:], *ring[:begin])],
            [edges[0][2], ends[1], edges[1][2], *links[1], *chain(*ring[end:back])],
            [edges[0][1], links[0][0], links[1][0], *chain(*ring[begin:end])],
            [edges[1][1], links[0][1], links[1][1], *chain(*ring[back:front])],
        ]
        surfaces = [geo.addPlaneSurface([geo.addCurveLoop(loop, reorient=True)]) for loop in loops]
        for line in {*lines, *chain(*ring)}:
            geo.mesh.setTransfiniteCurve(line, 2)
        geo.synchronize()
        mesh.setPeriodic(1, edges[1], edges[0], [1, 0, 0, root.pitch, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
        gmsh.option.setNumber("Mesh.MeshSizeMax", _TOP * root.step * np.hypot(1.0, root.stagger.deriv()(0.0)))
        mesh.generate(2)
        tags, coordinates, _ = mesh.getNodes()
        number = np.zeros(int(tags.max()) + 1, dtype=np.int64)
        entities = chain.from_iterable(enumerate(pair) for pair in zip(points, lines, strict=True))
        known = [mesh.getNodes(*entity)[0][0] for entity in entities]
        outside = ~np.isin(tags, known)
        number[known], number[tags[outside]] = round_root, len(own) + np.arange(outside.sum())
        triangles = [number[mesh.getElementsByType(_TRIANGLE6, surface)[1]].reshape(-1, 6) for surface in surfaces]
        faces = [np.unique(number[np.concatenate([mesh.getNodes(1, line, True)[0] for line in side])]) for side in edges]
    places = np.concatenate([own, coordinates.reshape(-1, 3)[outside, :2]])
    # the last two surfaces
    above_web = np.arange(sum(map(len, triangles))) >= sum(map(len, triangles[:-2]))
    pairs = np.stack([side[np.argsort(places[side, 1])] for side in faces], axis=1)
    below = {"wedge15": (np.concatenate(triangles), above_web), "hexahedron20": (root.faces, root.above_web)}
    return places, {kind: (_upright(nodes, places), above) for kind, (nodes, above) in below.items()}, pairs


def _upright(faces: ndarray, places: ndarray) -> ndarray:
    """The faces, corners and then mid-nodes, each turned so that its corners run from the first to the second axis."""
    corners, middles = np.split(faces, 2, axis=1)
    x, y = places[corners].transpose(2, 0, 1)
    area = np.sum(x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y, axis=1)
    back = np.hstack([np.roll(corners[:, ::-1], 1, axis=1), middles[:, ::-1]])
    return np.where(area[:, None] > 0.0, faces, back)
