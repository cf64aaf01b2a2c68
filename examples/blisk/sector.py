"""A sector of a small titanium blisk, meshed by gmsh so that its low face turned by one sector is its high face.

Run it in this folder with `python sector.py`: it writes sector.msh. The rotor turns about z.
"""

import sys
from math import cos, pi, sin

import gmsh

SECTORS = 18
BORE, RIM, PLATFORM, TIP = 0.08, 0.16, 0.17, 0.22  # radii (m)
WEB, WIDTH = 0.004, 0.032  # axial widths of web and rim (m)
CHORD, THICKNESS, STAGGER = 0.034, 0.003, 35.0  # m, m, degrees


def ring(inner: float, outer: float, width: float, sectors: int) -> int:
    """Volume of a sector of a ring about z, symmetric to x."""
    start = gmsh.model.occ.addRectangle(inner, -0.5 * width, 0.0, outer - inner, width)
    gmsh.model.occ.rotate([(2, start)], 0, 0, 0, 1, 0, 0, pi / 2)
    gmsh.model.occ.rotate([(2, start)], 0, 0, 0, 0, 0, 1, -pi / sectors)
    parts = gmsh.model.occ.revolve([(2, start)], 0, 0, 0, 0, 0, 1, 2 * pi / sectors)
    return next(tag for dimension, tag in parts if dimension == 3)


def mesh_sector(file: str, sectors: int = SECTORS, copies: int = 1, size: float = 0.008) -> None:
    """Mesh a sector, or the whole disc of `copies` equal sectors; `size` (m) of its elements, half of it in the blade."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    occ = gmsh.model.occ
    web, rim = ring(BORE, RIM, WEB, sectors), ring(RIM, PLATFORM, WIDTH, sectors)
    blade = occ.addBox(PLATFORM - 0.004, -0.5 * THICKNESS, -0.5 * CHORD, TIP - PLATFORM + 0.01, THICKNESS, CHORD)
    occ.rotate([(3, blade)], 0, 0, 0, 1, 0, 0, STAGGER * pi / 180)
    end = occ.addCylinder(0, 0, -0.1, 0, 0, 0.2, TIP)
    (blade,), _ = occ.intersect([(3, blade)], [(3, end)])
    occ.fuse([(3, web)], [(3, rim), blade])
    occ.synchronize()
    faces = {"low": -pi / sectors, "high": pi / sectors}
    sets: dict[str, list[int]] = {"bore": [], "tip": [], "low": [], "high": []}
    for _, tag in gmsh.model.getEntities(2):
        x, y, _ = occ.getCenterOfMass(2, tag)
        plane = {name: abs(-x * sin(angle) + y * cos(angle)) < 1e-6 for name, angle in faces.items()}
        normal = gmsh.model.getType(2, tag)
        radius = (x * x + y * y) ** 0.5
        name = next((side for side, lies in plane.items() if lies), None)
        name = name or ("tip" if radius > TIP - 1e-3 else "bore" if radius < BORE + 1e-3 and normal == "Cylinder" else None)
        if name:
            sets[name].append(tag)
    turn = 2 * pi / sectors
    matrix = [cos(turn), -sin(turn), 0, 0, sin(turn), cos(turn), 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]

    def height(tag: int) -> tuple[float, ...]:
        x, y, z = occ.getCenterOfMass(2, tag)
        return round((x * x + y * y) ** 0.5, 6), round(z, 6)

    low, high = (sorted(sets[side], key=height) for side in ("low", "high"))
    gmsh.model.mesh.setPeriodic(2, high, low, matrix)
    for name, tags in sets.items():
        gmsh.model.addPhysicalGroup(2, tags, name=name)
    gmsh.model.addPhysicalGroup(3, [tag for _, tag in gmsh.model.getEntities(3)], name="solid")
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    field = gmsh.model.mesh.field
    box = field.add("Box")
    for key, value in {
        "VIn": 0.5 * size,
        "VOut": size,
        "XMin": PLATFORM,
        "XMax": 1.0,
        "YMin": -1,
        "YMax": 1,
        "ZMin": -1,
        "ZMax": 1,
    }.items():
        field.setNumber(box, key, value)
    field.setAsBackgroundMesh(box)
    gmsh.option.setNumber("Mesh.ElementOrder", 2)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.model.mesh.generate(3)
    gmsh.write(file)
    gmsh.finalize()


if __name__ == "__main__":
    mesh_sector(sys.argv[1] if len(sys.argv) > 1 else "sector.msh")
