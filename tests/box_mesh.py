"""A box of wedges, clamped at one end: the structure whose exact answers are known."""

import numpy as np

from r37core.fem.wedge15 import NODES
from r37core.mesh.wedge_mesh import WedgeMesh


def box_mesh(length, width, height, counts, origin=(0.0, 0.0, 0.0), warp=0.0):
    """Wedges in a box: x along `length` (clamped at its start), y along `width`, z along `height` (extrusion).

    `counts`: cells along x, y, z, each cut into two wedges. `warp` moves inner nodes smoothly, for the patch test.
    """
    cells_x, cells_y, cells_z = counts
    corners = []
    for i in range(cells_x):
        for j in range(cells_y):
            for k in range(cells_z):
                quad = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                for triangle in ((quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])):
                    corners.append([(*p, k + up) for up in (0, 1) for p in triangle])
    corners = np.array(corners, dtype=float)
    area = np.stack([1.0 - NODES[:, 0] - NODES[:, 1], NODES[:, 0], NODES[:, 1]], axis=1)
    rise = (1.0 + NODES[:, 2:]) / 2.0
    weights = np.concatenate([area * (1.0 - rise), area * rise], axis=1)
    grid, elements = np.unique(
        np.round(2.0 * np.einsum("ac,eci->eai", weights, corners)).astype(int).reshape(-1, 3),
        axis=0,
        return_inverse=True,
    )
    share = grid / (2.0 * np.array(counts))
    points = share * np.array([length, width, height])
    bump = np.prod(share * (1.0 - share), axis=1)
    points = points + warp * bump[:, None] * np.array([length, -width, 0.5 * height]) + np.array(origin)
    parameters = np.stack([share[:, 1], share[:, 0], 2.0 * share[:, 2] - 1.0], axis=1)
    normals = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    return WedgeMesh(points, elements.reshape(-1, 15), parameters, normals)
