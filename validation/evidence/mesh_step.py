"""A blade's STEP file meshed by gmsh in tetrahedra or hexahedra: what another program would make of our blade."""

from pathlib import Path

import gmsh
import numpy as np

from r37core.mesh.generate import quiet_gmsh


def mesh_step(step: Path | str, msh: Path | str, element: str, along_chord: int, along_span: int, layers: int = 1) -> None:
    """Mesh a file of `write_step` in second-order elements and write it as .msh, in mm, with the groups root, tip and blade.

    `element`: `tetra10` or `hexahedron20`; with `along_chord`, `along_span` and `layers` (through the thickness) elements on
    the curves of the blade.
    """
    with quiet_gmsh():
        gmsh.model.occ.importShapes(str(step))
        gmsh.model.occ.synchronize()
        _divide_curves(along_chord, along_span, layers)
        faces = sorted(gmsh.model.getEntities(2), key=lambda face: _radius(*face))
        for group, (_, face) in (("root", faces[0]), ("tip", faces[-1])):
            gmsh.model.addPhysicalGroup(2, [face], name=group)
        gmsh.model.addPhysicalGroup(3, [1], name="blade")
        for _, face in faces:
            gmsh.model.mesh.setTransfiniteSurface(face)
            if element == "hexahedron20":
                gmsh.model.mesh.setRecombine(2, face)
        if element == "hexahedron20":
            gmsh.model.mesh.setTransfiniteVolume(1)
        else:
            # without both, flat tetrahedra at the round edges fold
            gmsh.option.setNumber("Mesh.HighOrderOptimize", 1)
            gmsh.option.setNumber("Mesh.OptimizeNetgen", 1)
        gmsh.model.mesh.generate(3)
        gmsh.write(str(msh))


def _divide_curves(along_chord: int, along_span: int, layers: int) -> None:
    """Elements on the twelve curves: four along the span, the others along the chord or round an edge."""
    for _, curve in gmsh.model.getEntities(1):
        ends = [np.array(gmsh.model.getValue(0, tag, [])) for _, tag in gmsh.model.getBoundary([(1, curve)])]
        radii = [np.hypot(*end[:2]) for end in ends]
        length = gmsh.model.occ.getMass(1, curve)
        if abs(radii[0] - radii[1]) > 0.5 * length:
            count = along_span
        else:
            count = along_chord if length > _NOSE * _tip_or_root_length() else layers
        gmsh.model.mesh.setTransfiniteCurve(curve, count + 1)


_NOSE = 0.2  # of the longest curve: those shorter run round the leading or trailing edge


def _tip_or_root_length() -> float:
    return max(gmsh.model.occ.getMass(1, curve) for _, curve in gmsh.model.getEntities(1))


def _radius(dimension: int, tag: int) -> float:
    return float(np.hypot(*gmsh.model.occ.getCenterOfMass(dimension, tag)[:2]))
