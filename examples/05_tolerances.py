"""5. Tolerances: how far a peak goes when friction and clearance are known to percents only.

Run it with `python examples/05_tolerances.py`: about two minutes on one core. Members of the scene are drawn, and run at the
same speeds as the blade itself.
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
speeds: [{ start: 1680, stop: 1760, step: 20 }]
tolerances:
  members: 4
  of_scenes:
    friction.coefficient: { uniform_percent: 10 }
    casing.clearance_m: { uniform_percent: 5 }
"""

with TemporaryDirectory() as name:
    study = r37.init(Path(name) / "study")
    (study / "config/my_tolerances.yaml").write_text(CHANGES)
    asked = ["--cores", "1", "--configfile", "config/config.yaml", "config/my_tolerances.yaml"]
    subprocess.run([sys.executable, "-m", "snakemake", "tolerances", *asked], cwd=study, check=True)
    members = r37.open_results(study / "results")["tolerances"].load()

stress = 1e-9 * members.largest_stress.sel(blade="Ref", scene="abradable")
print("members:", ", ".join(f"{number:.2f} GPa" for number in stress.values))
low, middle, high = 1e-9 * members.max_von_mises_quantile.sel(blade="Ref", scene="abradable").max("speed")
print(f"the peak has {low:.2f} to {high:.2f} GPa in nine tenths of them, {middle:.2f} in the middle")
assert stress.min() <= low < middle < high <= stress.max()
