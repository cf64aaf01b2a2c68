"""2. A mesh of another program: a plate set at 45 degrees, and the frequency that beam theory gives it.

Run it with `python examples/02_imported_mesh.py`: about a minute on one core. A plate is no blade, but its first bending
frequency has a closed form. Clamped at the hub, of length L and thickness t (Euler-Bernoulli; Blevins, Formulas for Natural
Frequency and Mode Shape, 1979, table 8-1): f = 1.8751^2 / (2 pi L^2) sqrt(E t^2 / (12 rho)).
"""

from math import pi, sqrt
from pathlib import Path
from tempfile import TemporaryDirectory

import gmsh

import r37

HUB, LENGTH, CHORD, THICKNESS = 200.0, 60.0, 12.0, 2.0  # mm
BLADES = """
Plate:
  mesh: plate.inp # Abaqus text
  length_unit: mm
  material: { youngs_modulus_pa: 180.0e+9, density_kg_m3: 8000.0, poissons_ratio: 0.3, yield_stress_pa: 1.38e+9 }
  rotor_axis: [1, 0, 0]
  radial: [0, 0, 1]
  rotation: positive
  root: { r_at_most_m: 0.2001 } # faces by a rule: the plate's foot
  tip: { r_at_least_m: 0.26 }
"""

with TemporaryDirectory() as name:
    folder = Path(name)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    plate = (3, gmsh.model.occ.addBox(-CHORD / 2, -THICKNESS / 2, HUB, CHORD, THICKNESS, LENGTH))
    gmsh.model.occ.rotate([plate], 0, 0, 0, 0, 0, 1, pi / 4)
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMax", 1.5)  # eight patches of the tip need 15 nodes along its edge
    gmsh.option.setNumber("Mesh.ElementOrder", 2)
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 1)  # hexahedra of 20 nodes
    gmsh.model.mesh.setTransfiniteAutomatic()
    gmsh.model.mesh.generate(3)
    gmsh.write(str(folder / "plate.inp"))
    gmsh.finalize()
    (folder / "blades.yaml").write_text(BLADES)
    diagram = r37.campbell(r37.blade("Plate", file=folder / "blades.yaml"), fidelity="draft")

first = diagram.frequency.sel(mode="1B", speed=0).item()
beam = 1.8751**2 / (2 * pi * (1e-3 * LENGTH) ** 2) * sqrt(180.0e9 * (1e-3 * THICKNESS) ** 2 / 12 / 8000.0)
print(f"1B at rest: {first:.1f} Hz; of a beam {beam:.1f} Hz")
assert abs(first / beam - 1.0) < 0.02
