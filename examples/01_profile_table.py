"""1. A blade of one's own from a table of profiles: a thicker one, of titanium.

Run it with `python examples/01_profile_table.py`: about a minute on one core. A bending frequency goes with the thickness and
with the speed of sound of the material, sqrt(E / rho), and the example checks that.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import pandas as pd

import r37

THICKER = 1.2
BLADES = """
Mine:
  profiles: profiles.csv # found beside this file
  material: { youngs_modulus_pa: 114.0e+9, density_kg_m3: 4430.0, poissons_ratio: 0.33, yield_stress_pa: 9.0e+8 }
"""

with TemporaryDirectory() as name:
    folder = Path(name)
    # the benchmark's profiles, with thicker edges and middles: docs/blades.md says what the columns are
    profiles = pd.read_csv(r37.init(folder / "study") / "config/profiles/rotor37.csv")
    profiles[["t_i_cm", "t_m_cm", "t_o_cm"]] *= THICKER
    profiles.to_csv(folder / "profiles.csv", index=False)
    (folder / "blades.yaml").write_text(BLADES)
    mine = r37.campbell(r37.blade("Mine", file=folder / "blades.yaml"), fidelity="draft")

reference = r37.campbell("Ref", fidelity="draft")
first, former = (diagram.frequency.sel(mode="1B", speed=0).item() for diagram in (mine, reference))
crossing = mine.crossing_speed.sel(mode="1B", engine_order=6).item()
print(f"1B at rest: {first:.0f} Hz, of the reference blade {former:.0f} Hz; it crosses engine order 6 at {crossing:.0f} rad/s")

sound = (114.0e9 / 4430.0 / (180.0e9 / 8000.0)) ** 0.5
assert abs(first / former / (THICKER * sound) - 1.0) < 0.05, "a thin blade's bending frequency goes with its thickness"
