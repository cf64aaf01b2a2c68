"""4. A run-up: the faster a blade crosses an interaction, the less it moves.

Run it with `python examples/04_run_up.py`: about two minutes on one core. Run-ups are for the workflow, here in a folder of its
own. The blade is the reference, on an abradable lining, as its first bending mode crosses engine order 4.
"""

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import r37

CHANGES = """
fidelity: draft
blades: [Ref]
scenes: [abradable]
run_ups:
  slow: { crossing: { mode: 1B, engine_order: 4, first: -0.015, last: 0.07 }, rate_rad_s2: 300 }
  fast: { crossing: { mode: 1B, engine_order: 4, first: -0.015, last: 0.07 }, rate_rad_s2: 3000 }
"""

with TemporaryDirectory() as name:
    study = r37.init(Path(name) / "study")
    (study / "config/my_run_ups.yaml").write_text(CHANGES)
    asked = ["--cores", "1", "--configfile", "config/config.yaml", "config/my_run_ups.yaml"]
    subprocess.run([sys.executable, "-m", "snakemake", "run_ups", *asked], cwd=study, check=True)
    run_ups = r37.open_results(study / "results")["run_ups"].load()

largest = run_ups.maximum_normal.sel(tip_point="leading_edge").max("revolution")
peaks = dict(zip(run_ups.run_up.values, largest.values, strict=True))
for name, rate in zip(run_ups.run_up.values, run_ups.rate.values, strict=True):
    print(f"at {rate:g} rad/s2: up to {1e3 * peaks[name]:.2f} mm towards the casing")
assert 0.0 < peaks["fast"] < peaks["slow"]
