"""Two blades compared.

The swept blade peaks at a lower speed, because its first bending mode is lower.
"""

import matplotlib.pyplot as plt

import r37

speeds = {"start": 1520, "stop": 1780, "step": 20, "refine_to": 2}
results = r37.run(["Ref", "CS50"], "abradable", speeds, fidelity="draft", cores=2)

figure, axes = plt.subplots(layout="constrained")
for blade in ("Ref", "CS50"):
    stress = results.response(blade, "abradable").max_von_mises_ever.sel(region="airfoil")
    axes.plot(stress.speed, 1e-9 * stress, ".-", label=blade)
axes.set(xlabel="speed (rad/s)", ylabel="largest von Mises stress (GPa)")
axes.legend()
