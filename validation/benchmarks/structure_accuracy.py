"""What mesh density, layers and edge form do to the reference blade's frequencies, as a table in Markdown.

Run: python validation/benchmarks/structure_accuracy.py   (about five minutes; --quick leaves out the finest meshes)
"""

import os
import sys
import time
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

from r37core.fem.matrices import assemble
from r37core.fem.solver import lowest_modes
from r37core.mesh.generate import generate_mesh
from r37core.product.reading import read_settings
from r37core.results.campbell import campbell_diagram
from r37core.rom.reduce import reduce_blade

ROOT = Path(__file__).parents[2]
PUBLISHED = {7: 806.0, 6: 965.0, 5: 1213.0, 4: 1672.0}
CASES = [
    ("round", 2500, 1, 14),
    ("round", 5000, 1, 21),
    ("round", 10000, 1, 28),
    ("round", 20000, 1, 42),
    ("blunt", 20000, 1, 42),
    ("round", 40000, 1, 56),
    ("round", 20000, 2, 35),
    ("round", 60000, 2, 56),
]


def main():
    settings = read_settings(ROOT)
    reference = settings.blades["Ref"]
    choice = settings.reduction_choice("Ref")
    print("| edges | nodes | layers | first six frequencies at rest (Hz) | 1B crossings with 7, 6, 5, 4 (rad/s) | off by | s |")
    print("|---|---|---|---|---|---|---|")
    for edges, nodes, layers, tip_elements in CASES:
        if nodes > 20000 and "--quick" in sys.argv:
            continue
        start = time.perf_counter()
        mesh = generate_mesh(reference.definition.build(edges == "round"), nodes, layers, tip_elements)
        matrices = assemble(mesh, reference.material)
        values, _ = lowest_modes(matrices.stiffness(), matrices.mass(), 6)
        model = reduce_blade(mesh, matrices, choice)
        crossings = campbell_diagram(model, np.linspace(0.0, 2000.0, 41), 3).crossing_speeds(np.array(list(PUBLISHED)))[0]
        off = 100.0 * (crossings / np.array(list(PUBLISHED.values())) - 1.0)
        frequencies = np.sqrt(values) / (2.0 * np.pi)
        cells = [
            edges,
            str(len(mesh.points)),
            str(layers),
            ", ".join(f"{f:.2f}" for f in frequencies),
            ", ".join(f"{c:.1f}" for c in crossings),
            f"{off.min():+.2f} to {off.max():+.2f}%",
            f"{time.perf_counter() - start:.0f}",
        ]
        print("| " + " | ".join(cells) + " |", flush=True)


main()
