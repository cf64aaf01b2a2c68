"""A family of designs.

More of the sweep of S100 loses less clearance as the blade swings.
"""

import r37

family = r37.blade("S100", name="Sweep", vary={"sweep_percent": [0, 25, 50, 75, 100]})
speeds = {"start": 1550, "stop": 1780, "step": 20, "refine_to": 5}
results = r37.run(family, "abradable", speeds, fidelity="draft", cores=2)

figure = r37.plot_designs(results)
