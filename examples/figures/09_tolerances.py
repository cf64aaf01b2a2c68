"""Uncertain friction and clearance.

Range of 90% of the members, chance of passing yield, and effect of each number.
"""

import r37

spread = {"friction.coefficient": {"uniform_percent": 10}, "casing.clearance_m": {"uniform_percent": 5}}
tolerances = {"of_scenes": spread, "members": 16}
speeds = {"start": 1660, "stop": 1780, "step": 10}
results = r37.run("Ref", "abradable", speeds, tolerances=tolerances, fidelity="draft", cores=2)

figure = r37.plot_tolerances(results, "Ref", "abradable")
