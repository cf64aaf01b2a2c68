"""CPU of the time integration alone, of this checkout and another one in turns: a table of docs/speed.md.

Run: make all_blades; python validation/benchmarks/integration_cost.py FOLDER, another checkout in which make setup was done; then make
claims ONLY=integration_cost TAKEN=yes. Both take the reduced models of this checkout, and each the steps of its own level.
"""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

from r37core.io import write_text
from r37core.product.reading import read_settings
from r37core.rom.contact_model import read_contact_model
from r37core.time_integration.simulate import Simulation
from validation.studies.tables import markdown_table

ROOT = Path(__file__).resolve().parents[2]
CASES = (
    ("Ref", "direct", 1340.0),
    ("S100", "direct", 1600.0),
    ("CS100", "direct", 1000.0),
    ("Ref", "abradable", 1340.0),
    ("CS100", "abradable", 1350.0),
)
TURNS, RUNS = 3, 15


def timed(checkout):
    """Modes stepped, largest step (s) and least CPU time (s) of each case, as JSON: run by the Python of the checkout."""
    settings, measured = read_settings(Path(checkout)), []
    for blade, scene, speed in CASES:
        model = read_contact_model(ROOT / f"results/{blade}/contact_{settings.scenes[scene].tip_line}.npz")
        choice = settings.integration_choice(blade, scene, speed)
        simulation, taken = Simulation(model, speed, settings.scenes[scene].scene, choice), []
        for _ in range(RUNS):
            state, begun = simulation.start(), time.process_time()
            simulation.advance(state, choice.revolutions)
            taken.append(time.process_time() - begun)
        measured.append((len(simulation.problem.blade.frequencies), choice.time_step, min(taken)))
    return json.dumps(measured)


def of_checkout(checkout):
    """What `timed` gives there."""
    command = [str(checkout / ".venv/bin/python"), str(Path(__file__).resolve()), "--timed", str(checkout)]
    return json.loads(subprocess.run(command, cwd=checkout, capture_output=True, text=True, check=True).stdout.splitlines()[-1])


def main(other):
    turns = [[of_checkout(checkout) for checkout in (other, ROOT)] for _ in range(TURNS)]
    rows = []
    for number, (blade, scene, speed) in enumerate(CASES):
        (modes_before, step_before, _), (modes, step, _) = turns[0][0][number], turns[0][1][number]
        before, now = (min(turn[which][number][2] for turn in turns) for which in range(2))
        cells = [f"{blade}, {speed:g}", f"`{scene}`", f"{1e3 * before:.1f}: {modes_before} modes, {step_before:g} s"]
        rows.append([*cells, f"{1e3 * now:.1f}: {modes} modes, {step:g} s", f"{now / before:.2f}"])
    head = ["blade, rad/s", "scene", "before (ms)", "now (ms)", "ratio"]
    write_text(markdown_table(head, rows), ROOT / "results/studies/integration_cost.md")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--timed"]:
        print(timed(sys.argv[2]))
    else:
        main(Path(sys.argv[1]).resolve())
