"""The seven blades as another program would mesh them: frequencies and the peak of 1B/4 beside those of our wedges.

Each blade goes out as STEP, is meshed by gmsh in tetrahedra and hexahedra with about as many nodes as the wedges of the level
`standard`, comes back as a mesh of another program in mm, and is taken to its frequencies and through a sweep over its
interaction of 1B with order 4 in the scene `abradable`. The table goes into docs/your_blade.md.

Run: python validation/benchmarks/remeshed_blades.py [blade ...]   (about two minutes for each blade; --frequencies: without the sweeps)
What was measured before is kept in results/studies/remeshed.json; delete that to measure again. The peak is looked for every
2 rad/s on a branch that rises steeply to its drop: one step more or less is some percent of its rms.
"""

import os
import sys
import tempfile
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
from mesh_step import mesh_step

from r37core.config.imported_entry import MeshEntry
from r37core.exchange.importing.import_mesh import import_mesh
from r37core.exchange.step_file import write_step
from r37core.fem.matrices import assemble
from r37core.fem.solver import lowest_modes
from r37core.io import read_json, write_json, write_text
from r37core.mesh.generate import generate_mesh
from r37core.product.reading import read_settings
from r37core.results.campbell import campbell_diagram
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.time_integration.speed_run import run_speed

ROOT = Path(__file__).parents[2]
KEPT = ROOT / "results" / "studies" / "remeshed.json"
OURS = "wedge15"
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
    frame = {"length_unit": "mm", "rotor_axis": [0.0, 0.0, 1.0], "radial": [1.0, 0.0, 0.0], "rotation": "negative"}
    entry = MeshEntry(mesh=str(msh), material={}, root="root", tip="tip", **frame)
    return import_mesh(entry.source(folder))[0]


def frequencies_of(matrices):
    """First six frequencies (Hz) at rest."""
    values, _ = lowest_modes(matrices.stiffness(), matrices.mass(), 6)
    return (np.sqrt(values) / (2.0 * np.pi)).tolist()


def peak_of(name, mesh, matrices, settings):
    """Speed (rad/s) and rms (m) of the peak of 1B/4."""
    model = reduce_blade(mesh, matrices, settings.reduction_choice(name))
    crossing = campbell_diagram(model, np.linspace(0.0, 2000.0, 41), 3).crossing_speeds(np.array([ORDER]))[0, 0]
    contact = contact_model(model, settings.structure.boundary.tip_line)
    chosen = settings.scenes["abradable"]
    speeds = np.arange(np.ceil(RANGE[0] * crossing / SPEED_STEP), RANGE[1] * crossing / SPEED_STEP) * SPEED_STEP
    rms = []
    for speed in speeds:
        choice = settings.integration_choice(name, "abradable", speed)
        few = {"spectrum_highest_order": 1, "wear_angles": 8}
        rms.append(run_speed(contact, speed, chosen.scene, choice, (), **few)["rms"][0, 0])
    peak = int(np.argmax(rms))
    return float(speeds[peak]), float(rms[peak])


def measure(name, settings, with_peak, table):
    """Measure what `table` lacks of a blade."""
    chosen, level = settings.blades[name], settings.fidelity.mesh
    blade = chosen.definition.build(round_edges=True)
    with tempfile.TemporaryDirectory() as folder:
        for element in (OURS, *ELEMENTS):
            row = table.setdefault(f"{name} {element}", {})
            if "frequencies" in row and ("peak" in row or not with_peak):
                continue
            if element == OURS:
                mesh = generate_mesh(blade, level.nodes, level.layers, level.tip_elements)
            else:
                mesh = imported(blade, element, Path(folder))
            matrices = assemble(mesh, chosen.material)
            row |= {"nodes": len(mesh.points), "frequencies": frequencies_of(matrices)}
            if with_peak:
                row["peak"], row["rms"] = peak_of(name, mesh, matrices, settings)
            write_json(table, KEPT)


def table(measured, blades):
    """The table of what was measured; differences from our wedges."""
    lines = [
        "| blade | mesh | nodes | six frequencies at rest (Hz) | off by up to | peak of 1B/4 (rad/s) | off by | its rms (mm) |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for name in blades:
        ours = measured.get(f"{name} {OURS}")
        for element in (OURS, *ELEMENTS):
            row = measured.get(f"{name} {element}")
            if not row:
                continue
            cells = [name, element, str(row["nodes"]), ", ".join(f"{f:.2f}" for f in row["frequencies"])]
            off = np.abs(np.array(row["frequencies"]) / ours["frequencies"] - 1.0).max()
            cells.append("" if element == OURS else f"{100.0 * off:.3f}%")
            cells.append(f"{row['peak']:g}" if "peak" in row else "")
            cells.append(f"{100.0 * (row['peak'] / ours['peak'] - 1.0):+.2f}%" if "peak" in row and element != OURS else "")
            cells.append(f"{1e3 * row['rms']:.3f}" if "rms" in row else "")
            lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def main():
    settings = read_settings(ROOT)
    names = [word for word in sys.argv[1:] if not word.startswith("--")]
    measured = read_json(KEPT) if KEPT.exists() else {}
    for name in names or settings.blades:
        measure(name, settings, "--frequencies" not in sys.argv, measured)
        print(table(measured, [name]), flush=True)
    write_text(table(measured, settings.blades) + "\n", KEPT.with_suffix(".md"))


if __name__ == "__main__":
    main()
