"""Campbell diagram of a changed blade.

Dots are crossings of modes and engine orders: possible resonances.
"""

import r37

swept = r37.blade("Ref", chordwise_sweep_deg=7, name="Swept")
diagram = r37.campbell(swept, fidelity="draft")
print(diagram.crossing_speed.sel(mode="1B").to_series().dropna().round(1))

figure = r37.plot_campbell(diagram)
