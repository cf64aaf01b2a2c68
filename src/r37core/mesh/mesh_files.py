"""Mesh files: .vtu, which later stages and ParaView read."""

from pathlib import Path

import numpy as np
import pyvista
from numpy import ndarray
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from r37core.base.io import atomic_write, readable

from .blade_mesh import NODE_SETS, BladeMesh, along_chord

_PARAMETERS = ("chord", "span", "thickness")
_PARTNER = "cyclic_partner"
"""Data of the nodes of a sector's low face: the node of the high face that each becomes, -1 elsewhere."""
_CELL_TYPES = {
    "tetra10": pyvista.CellType.QUADRATIC_TETRA,
    "wedge15": pyvista.CellType.QUADRATIC_WEDGE,
    "hexahedron20": pyvista.CellType.QUADRATIC_HEXAHEDRON,
    "tetra": pyvista.CellType.TETRA,
    "wedge": pyvista.CellType.WEDGE,
    "hexahedron": pyvista.CellType.HEXAHEDRON,
}


def vtk_grid(mesh: BladeMesh) -> pyvista.UnstructuredGrid:
    """The bare mesh as VTK's object; cells in the order of the mesh's blocks."""
    return pyvista.UnstructuredGrid({_CELL_TYPES[name]: nodes for name, nodes in mesh.blocks.items()}, mesh.points)


def save_grid(grid: pyvista.UnstructuredGrid, file: Path) -> None:
    """Write a grid as .vtu. Not by VTK itself, which a full disk ends, and Python with it."""
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetDataModeToBinary()
    writer.WriteToOutputStringOn()
    writer.Write()
    file.write_text(writer.GetOutputString(), encoding="ascii")


def write_vtu(mesh: BladeMesh, file: Path | str, scaled_jacobian: ndarray) -> None:
    """Write the mesh with each node's parameters and normal, its node sets as 0/1 marks, and each element's quality.

    `scaled_jacobian`: shape (elements,); its minimum and 1% quantile go into the field data.
    """
    grid = vtk_grid(mesh)
    for name, values in zip(_PARAMETERS, mesh.parameters.T, strict=True):
        grid.point_data[name] = values
    grid.point_data["normal"] = mesh.normals
    for name in NODE_SETS:
        grid.point_data[name] = mesh.mask(name).astype(np.int8)
    if mesh.cyclic is not None:
        partners = np.full(len(mesh.points), -1)
        partners[mesh.cyclic[:, 0]] = mesh.cyclic[:, 1]
        grid.point_data[_PARTNER] = partners
    grid.cell_data["scaled_jacobian"] = scaled_jacobian
    grid.field_data["scaled_jacobian_minimum"] = [np.min(scaled_jacobian)]
    grid.field_data["scaled_jacobian_one_percent_quantile"] = [np.quantile(scaled_jacobian, 0.01)]
    with atomic_write(file) as partial:
        save_grid(grid, partial)


def read_vtu(file: Path | str) -> BladeMesh:
    """The mesh of a .vtu written by `write_vtu`; InputFileError when it cannot be read."""
    with readable(file):
        grid = pyvista.read(file)
        parameters = np.stack([grid.point_data[name] for name in _PARAMETERS], axis=1)
        cells = grid.cells_dict
        partners = grid.point_data.get(_PARTNER)
        return BladeMesh(
            np.array(grid.points),
            {name: cells[kind].astype(np.int64) for name, kind in _CELL_TYPES.items() if kind in cells},
            parameters,
            np.array(grid.point_data["normal"]),
            {name: along_chord(np.flatnonzero(grid.point_data[name]), name, parameters[:, 0]) for name in NODE_SETS},
            None if partners is None else np.stack([np.flatnonzero(partners >= 0), partners[partners >= 0]], axis=1),
        )
