"""Effect of friction.

The same blade and lining with three coefficients of friction.
"""

import matplotlib.pyplot as plt

import r37

speeds = {"start": 1660, "stop": 1780, "step": 5}

figure, axes = plt.subplots(layout="constrained")
for coefficient in (0.05, 0.1, 0.15):
    scene = r37.scene("abradable", **{"friction.coefficient": coefficient})
    response = r37.sweep("Ref", scene, speeds, fidelity="draft", results=[], cores=2)
    tangential = response.rms_tangential.sel(tip_point="leading_edge")
    axes.plot(tangential.speed, 1e3 * tangential, ".-", label=f"friction {coefficient}")
axes.set(xlabel="speed (rad/s)", ylabel="rms, tangential, leading edge (mm)")
axes.legend()
