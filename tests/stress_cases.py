"""Nodes that tests of the stress share."""

import numpy as np


def inner_places(model, mesh):
    """Places in the region of the stress of three nodes all of whose elements belong to it."""
    region = model.stress_submesh.nodes
    outside = [nodes[~np.isin(nodes, region).all(axis=1)] for nodes in mesh.blocks.values()]
    inner = np.flatnonzero(~np.isin(region, np.concatenate([nodes.ravel() for nodes in outside])))
    return inner[[0, len(inner) // 2, -1]]
