"""A surface that moves, as a binary glTF file (.glb) with morph targets: what browsers and presentations show.

Only what this needs of glTF 2.0 (Khronos Group, ISO/IEC 12113:2022); no library that we found writes animated morph targets.
"""

import json
import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from r37core.base.io import atomic_write

_AXES = [2, 0, 1]
"""glTF has y upwards and z towards the viewer: its x y z are the blade's z (downstream), x (radial) and y."""

_FLOAT, _UINT16, _UINT32 = 5126, 5123, 5125
_TYPES = {(): "SCALAR", (3,): "VEC3", (4,): "VEC4"}
_VERTICES, _TRIANGLES = 34962, 34963


@dataclass(frozen=True)
class MovingSurface:
    """A surface whose points move as points + sum of weights(t) times targets.

    `points` (m), shape (points, 3), in the blade's frame; `triangles`, shape (triangles, 3), counter-clockwise seen from
    outside; `values`, shape (points,), of what the colours show; `colours`, shape (points, 3), sRGB from 0 to 1; `targets` (m),
    shape (targets, points, 3); `times` (s), shape (times,), from 0; `weights`, shape (times, targets); `rest_weights`, shape
    (targets,): the weights of a viewer that does not move; `about`: what the file says of itself.
    """

    points: np.ndarray
    triangles: np.ndarray
    values: np.ndarray
    colours: np.ndarray
    targets: np.ndarray
    times: np.ndarray
    weights: np.ndarray
    rest_weights: np.ndarray
    about: Mapping[str, object] = field(default_factory=dict)


def write_glb(surface: MovingSurface, name: str, file: Path | str) -> None:
    """Write the surface, atomically; values are the attribute _VALUE, `about` the extras of the asset.

    Without normals, so that viewers shade each triangle as it stands, moved.
    """
    buffer = _Buffer()
    attributes = {
        "POSITION": buffer.add(surface.points[:, _AXES], _FLOAT, _VERTICES, bounds=True),
        "COLOR_0": buffer.add(_linear(surface.colours), _UINT16, _VERTICES, normalized=True),
        "_VALUE": buffer.add(surface.values, _FLOAT, _VERTICES),
    }
    indices = buffer.add(surface.triangles.ravel(), _UINT32, _TRIANGLES)
    targets = [{"POSITION": buffer.add(target[:, _AXES], _FLOAT, _VERTICES, bounds=True)} for target in surface.targets]
    sampler = {
        "input": buffer.add(surface.times, _FLOAT, bounds=True),
        "output": buffer.add(surface.weights.ravel(), _FLOAT),
        "interpolation": "LINEAR",
    }
    material = {"doubleSided": True, "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.8}}
    primitive = {"attributes": attributes, "indices": indices, "targets": targets, "material": 0}
    content = {
        "asset": {"version": "2.0", "generator": "r37", "extras": dict(surface.about)},
        "scene": 0,
        "scenes": [{"nodes": [0], "name": name}],
        "nodes": [{"mesh": 0, "name": name}],
        "meshes": [
            {"primitives": [primitive], "weights": np.asarray(surface.rest_weights, dtype=float).tolist(), "name": name}
        ],
        "materials": [material],
        "animations": [
            {"channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}], "samplers": [sampler], "name": name}
        ],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": len(buffer.data)}],
    }
    with atomic_write(file) as partial:
        partial.write_bytes(_container(json.dumps(content, sort_keys=True).encode(), bytes(buffer.data)))


class _Buffer:
    """The binary chunk, with the views and accessors that say where an array lies in it."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, object]] = []
        self.accessors: list[dict[str, object]] = []

    def add(
        self, values: np.ndarray, kind: int, target: int | None = None, bounds: bool = False, normalized: bool = False
    ) -> int:
        """Number of the new accessor; `bounds`: whether it carries its smallest and largest values, as glTF asks of some."""
        array = np.ascontiguousarray(values, dtype={_FLOAT: "<f4", _UINT16: "<u2", _UINT32: "<u4"}[kind])
        view: dict[str, object] = {"buffer": 0, "byteOffset": len(self.data), "byteLength": array.nbytes}
        self.views.append(view | ({} if target is None else {"target": target}))
        self.data += array.tobytes()
        self.data += bytes(-len(self.data) % 4)
        accessor: dict[str, object] = {"bufferView": len(self.views) - 1, "componentType": kind, "count": len(array)}
        accessor |= {"type": _TYPES[array.shape[1:]]}
        if bounds:
            accessor |= {"min": np.atleast_1d(array.min(axis=0)).tolist(), "max": np.atleast_1d(array.max(axis=0)).tolist()}
        self.accessors.append(accessor | ({"normalized": True} if normalized else {}))
        return len(self.accessors) - 1


def _linear(colours: np.ndarray) -> np.ndarray:
    """sRGB colours as what glTF wants of vertices: linear, with opacity, in sixteen bits. Source: IEC 61966-2-1."""
    linear = np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)
    return np.round(65535.0 * np.column_stack([linear, np.ones(len(colours))]))


def _container(text: bytes, data: bytes) -> bytes:
    """Header, JSON chunk padded with spaces, binary chunk."""
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
