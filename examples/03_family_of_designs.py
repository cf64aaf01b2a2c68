"""3. A family of designs: how sweep changes the clearance that a blade loses as it swings.

Run it with `python examples/03_family_of_designs.py`: about three minutes on one core. The benchmark's authors found that
blades which close their gap less are the safer ones; a share of the sweep of S100 does that.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import r37

BLADES = """
Sweep: # the designs Sweep_0, Sweep_50 and Sweep_100
  base: S100
  vary:
    sweep_percent: [0, 50, 100]
"""

with TemporaryDirectory() as name:
    study = r37.init(Path(name) / "study")
    file = study / "config/blades.yaml"
    file.write_text(file.read_text() + BLADES)
    designs = [name for name in r37.blades(file=file) if name.startswith("Sweep_")]
    diagrams = {name: r37.campbell(r37.blade(name, file=file), fidelity="draft") for name in designs}

loss = {name: -diagram.dynamic_clearance.sel(mode="1B").min().item() for name, diagram in diagrams.items()}
for name, diagram in diagrams.items():
    frequency = diagram.frequency.sel(mode="1B", speed=0).item()
    print(f"{name}: 1B at {frequency:.0f} Hz, largest loss of clearance {1e3 * loss[name]:.2f} mm")
assert designs == ["Sweep_0", "Sweep_50", "Sweep_100"]
assert loss["Sweep_0"] > loss["Sweep_50"] > loss["Sweep_100"]
