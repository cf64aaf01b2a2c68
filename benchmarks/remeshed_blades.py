"""The seven blades as another program would mesh them: frequencies and the peak of 1B/4 beside those of our wedges.

Each blade goes out as STEP, is meshed by gmsh in tetrahedra and hexahedra with about as many nodes as the wedges of the level
`standard`, comes back as a mesh of another program in mm, and is taken to its frequencies and through a sweep over its
interaction of 1B with order 4 in the scene `abradable`. The table goes into docs/your_blade.md.

Run: python benchmarks/remeshed_blades.py   (about twenty minutes on one core; --quick: the reference blade alone, no table)
"""

import os
import sys
import tempfile
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
from pages import fill

from r37core.config import read_settings
from r37core.exchange.import_mesh import import_mesh
from r37core.exchange.mesh_step import mesh_step
from r37core.exchange.orientation import Orientation
from r37core.exchange.source import MeshSource
from r37core.exchange.step import write_step
from r37core.exchange.where import Where
from r37core.fem.matrices import assemble
from r37core.fem.solver import lowest_modes
from r37core.mesh.generate import generate_mesh
from r37core.results.campbell import campbell_diagram
from r37core.rom.contact_reduction import contact_model
from r37core.rom.reduce import reduce_blade
from r37core.time_integration.speed_run import run_speed

ROOT = Path(__file__).parent.parent
ELEMENTS = {"tetra10": (31, 50), "hexahedron20": (42, 68)}
"""Element -> how many along chord and span."""

ORDER, SPEED_STEP = 4, 2.0
RANGE = (0.98, 1.06)
"""Of the Campbell speed, where its peak is looked for."""


def imported(blade, element, folder):
    """The blade's mesh by way of STEP and gmsh."""
    step, msh = folder / "surface.step", folder / f"{element}.msh"
    if not step.exists():
        write_step(blade, step)
    mesh_step(step, msh, element, *ELEMENTS[element])
    orientation = Orientation("mm", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), "negative")
    return import_mesh(MeshSource(str(msh), orientation, Where("root"), Where("tip")))[0]


def measured(mesh, material, settings):
    """Nodes, first six frequencies (Hz) at rest, and speed (rad/s) and rms (m) of the peak of 1B/4."""
    matrices = assemble(mesh, material)
    values, _ = lowest_modes(matrices.stiffness(), matrices.mass(), 6)
    model = reduce_blade(mesh, matrices, settings.reduction_choice())
    crossing = campbell_diagram(model, np.linspace(0.0, 2000.0, 41), 3).crossing_speeds(np.array([ORDER]))[0, 0]
    contact = contact_model(model, settings.structure.boundary.tip_line)
    chosen = settings.scenes["abradable"]
    speeds = np.arange(np.ceil(RANGE[0] * crossing / SPEED_STEP), RANGE[1] * crossing / SPEED_STEP) * SPEED_STEP
    rms = []
    for speed in speeds:
        choice = settings.integration_choice("Ref", "abradable", speed)
        rms.append(run_speed(contact, speed, chosen.scene, choice, (), 1, 1, 8)["rms"][0, 0])
    peak = int(np.argmax(rms))
    return len(mesh.points), np.sqrt(values) / (2.0 * np.pi), float(speeds[peak]), float(rms[peak])


def main():
    settings = read_settings(ROOT)
    level = settings.fidelity.mesh
    lines = [
        "| blade | mesh | nodes | first six frequencies at rest (Hz) | off by up to | peak of 1B/4 (rad/s) | off by |",
        "|---|---|---|---|---|---|---|",
    ]
    print(*lines, sep="\n")
    for name in ["Ref"] if "--quick" in sys.argv else settings.blades:
        given = settings.blades[name]
        blade = given.definition.build()
        ours = None
        with tempfile.TemporaryDirectory() as folder:
            for element in ("wedge15", *ELEMENTS):
                if element == "wedge15":
                    mesh = generate_mesh(blade, level.nodes, level.layers, level.tip_elements)
                else:
                    mesh = imported(blade, element, Path(folder))
                nodes, frequencies, peak, _ = found = measured(mesh, given.material, settings)
                ours = ours or found
                off = np.abs(frequencies / ours[1] - 1.0).max()
                cells = [name, element, str(nodes), ", ".join(f"{f:.2f}" for f in frequencies)]
                cells += [f"{100.0 * off:.3f}%", f"{peak:g}", f"{100.0 * (peak / ours[2] - 1.0):+.2f}%"]
                if element == "wedge15":
                    cells[4] = cells[6] = ""
                lines.append(f"| {' | '.join(cells)} |")
                print(lines[-1], f"<!-- rms {1e3 * found[3]:.4f} mm -->", flush=True)
    if "--quick" not in sys.argv:
        fill(ROOT / "docs" / "your_blade.md", "remeshed", "\n".join(lines))


if __name__ == "__main__":
    main()
