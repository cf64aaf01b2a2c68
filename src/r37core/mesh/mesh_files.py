"""Mesh files: .vtu, which later stages and ParaView read, and an Abaqus/CalculiX deck to check us in another program."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pyvista

from r37core.io import atomic_write, readable

from .wedge_mesh import NODE_SETS, WedgeMesh

_PARAMETERS = ("chord", "span", "thickness")


def write_vtu(mesh: WedgeMesh, file: Path | str, scaled_jacobian: np.ndarray) -> None:
    """Write the mesh with each node's parameters and normal, its node sets as 0/1 marks, and each element's quality.

    `scaled_jacobian`: shape (elements,); its minimum and 1% quantile go into the field data.
    """
    cells = np.insert(mesh.elements, 0, 15, axis=1).ravel()
    types = np.full(len(mesh.elements), pyvista.CellType.QUADRATIC_WEDGE)
    grid = pyvista.UnstructuredGrid(cells, types, mesh.points)
    for name, values in zip(_PARAMETERS, mesh.parameters.T, strict=True):
        grid.point_data[name] = values
    grid.point_data["normal"] = mesh.normals
    for name in NODE_SETS:
        marks = np.zeros(len(mesh.points), dtype=np.int8)
        marks[mesh.node_set(name)] = 1
        grid.point_data[name] = marks
    grid.cell_data["scaled_jacobian"] = scaled_jacobian
    grid.field_data["scaled_jacobian_minimum"] = [np.min(scaled_jacobian)]
    grid.field_data["scaled_jacobian_one_percent_quantile"] = [np.quantile(scaled_jacobian, 0.01)]
    with atomic_write(file) as partial:
        grid.save(partial)


def read_vtu(file: Path | str) -> WedgeMesh:
    """The mesh of a .vtu written by `write_vtu`; InputFileError when it cannot be read."""
    with readable(file):
        grid = pyvista.read(file)
        parameters = np.stack([grid.point_data[name] for name in _PARAMETERS], axis=1)
        elements = grid.cells_dict[pyvista.CellType.QUADRATIC_WEDGE].astype(np.int64)
        return WedgeMesh(np.array(grid.points), elements, parameters, np.array(grid.point_data["normal"]))


def write_abaqus(
    mesh: WedgeMesh, file: Path | str, youngs_modulus: float, density: float, poissons_ratio: float, title: str
) -> None:
    """Write a complete CalculiX/Abaqus deck in SI units: mesh, node sets, material, clamped root, first ten modes.

    Run it with `ccx mesh` (without the suffix).
    """
    lines = ["*HEADING", title, "*NODE, NSET=ALL_NODES"]
    # CalculiX reads at most 20 characters per number
    lines += [f"{i}, {x:.12e}, {y:.12e}, {z:.12e}" for i, (x, y, z) in enumerate(mesh.points.tolist(), start=1)]
    lines.append("*ELEMENT, TYPE=C3D15, ELSET=BLADE")
    for i, nodes in enumerate((mesh.elements + 1).tolist(), start=1):
        lines.append(", ".join(map(str, [i, *nodes[:9]])) + ",")
        lines.append(", ".join(map(str, nodes[9:])))
    for name in NODE_SETS:
        lines.append(f"*NSET, NSET={name.upper()}")
        lines += _rows_of_ids(mesh.node_set(name) + 1)
    lines += [
        "*MATERIAL, NAME=BLADE_MATERIAL",
        "*ELASTIC",
        f"{youngs_modulus:.12g}, {poissons_ratio:.12g}",
        "*DENSITY",
        f"{density:.12g}",
        "*SOLID SECTION, ELSET=BLADE, MATERIAL=BLADE_MATERIAL",
        "*BOUNDARY",
        "ROOT, 1, 3",
        "*STEP",
        "*FREQUENCY",
        "10",
        "*NODE FILE",
        "U",
        "*END STEP",
    ]
    with atomic_write(file) as partial:
        partial.write_text("\n".join(lines) + "\n", encoding="ascii")


def _rows_of_ids(ids: np.ndarray) -> Iterable[str]:
    return [", ".join(map(str, ids[i : i + 12].tolist())) + "," for i in range(0, len(ids), 12)]
