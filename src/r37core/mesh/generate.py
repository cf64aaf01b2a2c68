"""Wedge mesh of a blade: gmsh meshes the (chord, span) rectangle and extrudes it; the nodes are mapped onto the blade."""

import ctypes
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import gmsh
import numpy as np
from numpy import ndarray

from r37core.blade.blade_map import BladeMap

from .blade_mesh import BladeMesh, parametric_node_sets

_TRIANGLE6, _PRISM15, _LINE2 = 9, 18, 1
# gmsh numbers the mid-nodes by edge 01 02 03 12 14 25 34 35 45; ours run bottom, top, vertical
_FROM_GMSH = [0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11]
_COUNT_TOLERANCE = 0.02


def generate_mesh(blade: BladeMap, nodes: int, layers: int, tip_elements: int, msh_file: Path | None = None) -> BladeMesh:
    """Mesh a blade with about `nodes` nodes, `layers` wedges through the thickness and `tip_elements` along the tip.

    With `msh_file` the mapped mesh is also written in gmsh's own format, with a physical group for every node set.
    Raises ValueError when the node count cannot be met with that many elements along the tip.
    """
    chord_length, span_length = blade.dimensions()
    with quiet_gmsh():
        size = _size_for(nodes, layers, tip_elements, chord_length, span_length)
        _build_rectangle(size, tip_elements, chord_length, span_length)
        top = gmsh.model.geo.extrude([(2, 1)], 0.0, 0.0, 2.0, numElements=[layers], recombine=True)
        gmsh.model.geo.synchronize()
        gmsh.model.mesh.generate(3)
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        order = np.argsort(tags)
        tags = tags[order]
        plane = coordinates.reshape(-1, 3)[order]
        parameters = plane / np.array([chord_length, span_length, 1.0]) - np.array([0.0, 0.0, 1.0])
        # within round-off of a face, or of the camber surface, they lie on it
        for value in (-1.0, 0.0, 1.0):
            parameters[np.abs(parameters - value) < 1e-9] = value
        # elements are the right way out where the third parameter runs with the angle about the axis
        parameters[:, 2] *= blade.thickness_sign
        _, element_nodes = gmsh.model.mesh.getElementsByType(_PRISM15)
        elements = np.searchsorted(tags, element_nodes).reshape(-1, 15)[:, _FROM_GMSH]
        chord, span, thickness = parameters.T
        mesh = BladeMesh(
            blade.position(chord, span, thickness),
            {"wedge15": elements},
            parameters,
            blade.normal(chord, span),
            parametric_node_sets(parameters),
        )
        if msh_file is not None:
            _write_msh(mesh, tags, top[1][1], msh_file)
    return mesh


@contextmanager
def quiet_gmsh() -> Iterator[None]:
    """A gmsh session without output, on one thread, for second-order elements without inner nodes."""
    # gmsh.initialize lets a broken pipe end the process, where Python raises an error. `signal.signal` refuses other threads
    handler = ctypes.CDLL(None).signal
    handler.restype, handler.argtypes = ctypes.c_void_p, [ctypes.c_int, ctypes.c_void_p]
    before = handler(signal.SIGPIPE, signal.SIG_IGN)
    gmsh.initialize(interruptible=False)
    handler(signal.SIGPIPE, before)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("General.NumThreads", 1)
        gmsh.option.setNumber("Mesh.ElementOrder", 2)
        gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 1)
        gmsh.option.setNumber("Mesh.MeshSizeFromPoints", 0)
        gmsh.option.setNumber("Mesh.Algorithm", 6)
        yield
    finally:
        gmsh.finalize()


def _build_rectangle(size: float, tip_elements: int, chord_length: float, span_length: float) -> None:
    """The parameter rectangle as gmsh surface 1; its four sides are curves 1 (hub), 2 (trailing), 3 (tip), 4 (leading)."""
    gmsh.clear()
    geo = gmsh.model.geo
    for x, y in ((0.0, 0.0), (chord_length, 0.0), (chord_length, span_length), (0.0, span_length)):
        geo.addPoint(x, y, 0.0)
    for start, end in ((1, 2), (2, 3), (3, 4), (4, 1)):
        geo.addLine(start, end)
    geo.addPlaneSurface([geo.addCurveLoop([1, 2, 3, 4])], 1)
    along_hub = max(2, round(chord_length / size))
    along_span = max(2, round(span_length / size))
    for curve, count in ((1, along_hub), (2, along_span), (3, tip_elements), (4, along_span)):
        geo.mesh.setTransfiniteCurve(curve, count + 1)
    geo.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)


def _size_for(nodes: int, layers: int, tip_elements: int, chord_length: float, span_length: float) -> float:
    """Element size (m) whose mesh has `nodes` nodes within 2%; a few trial meshes of the rectangle alone."""
    triangles = nodes / (2.5 * layers + 2.0)
    size = np.sqrt(chord_length * span_length / triangles * 4.0 / np.sqrt(3.0))
    best = (np.inf, size)
    for _ in range(12):
        _build_rectangle(size, tip_elements, chord_length, span_length)
        gmsh.model.mesh.generate(2)
        _, element_nodes = gmsh.model.mesh.getElementsByType(_TRIANGLE6)
        corners = np.unique(element_nodes.reshape(-1, 6)[:, :3]).size
        count = (layers + 1) * np.unique(element_nodes).size + layers * corners
        best = min(best, (abs(count / nodes - 1.0), size))
        if best[0] < _COUNT_TOLERANCE:
            return float(best[1])
        size *= np.sqrt(count / nodes)
    if best[0] > 0.1:
        raise ValueError(
            f"mesh: no mesh of about {nodes} nodes has {tip_elements} elements along the tip and {layers} layers; "
            "change nodes, tip_elements or layers of this fidelity level"
        )
    return float(best[1])


def _write_msh(mesh: BladeMesh, tags: ndarray, volume: int, file: Path) -> None:
    """Write the mapped mesh; physical groups: the volume `blade`, and faces or curves for the node sets."""
    for tag, point in zip(tags.tolist(), mesh.points.tolist(), strict=True):
        gmsh.model.mesh.setNode(tag, point, [])
    gmsh.model.addPhysicalGroup(3, [volume], name="blade")
    for name in ("root", "tip", "leading_edge", "trailing_edge", "tip_pressure_edge", "tip_suction_edge"):
        dimension = 1 if name.startswith("tip_") else 2
        gmsh.model.addPhysicalGroup(dimension, [_entity_of(dimension, tags[mesh.node_set(name)])], name=name)
    camber = tags[mesh.node_set("tip_camber_line")]
    if len(camber) > 1:
        line = gmsh.model.addDiscreteEntity(1)
        gmsh.model.mesh.addElementsByType(line, _LINE2, [], np.stack([camber[:-1], camber[1:]], axis=1).ravel())
        gmsh.model.addPhysicalGroup(1, [line], name="tip_camber_line")
    gmsh.write(str(file))


def _entity_of(dimension: int, node_tags: ndarray) -> int:
    """The gmsh entity of that dimension whose mesh has exactly these nodes."""
    wanted = set(node_tags.tolist())
    for _, entity in gmsh.model.getEntities(dimension):
        tags, _, _ = gmsh.model.mesh.getNodes(dimension, entity, includeBoundary=True)
        if set(tags.tolist()) == wanted:
            return int(entity)
    raise RuntimeError(f"gmsh made no entity of dimension {dimension} for one of the node sets")
