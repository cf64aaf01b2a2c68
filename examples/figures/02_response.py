"""Response over speed.

Adaptive speeds are close at the peaks; the largest lie slightly above dotted crossings.
"""

import r37

speeds = {"start": 900, "stop": 1800, "step": 20, "refine_to": 2}
response = r37.sweep("Ref", "abradable", speeds, fidelity="draft", cores=2)
diagram = r37.campbell("Ref", fidelity="draft")

figure = r37.plot_response(response, diagram)
