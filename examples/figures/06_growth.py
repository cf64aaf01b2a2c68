"""Stress per revolution.

Below, in and above the interaction of the first bending mode with engine order 4.
"""

import matplotlib.pyplot as plt

import r37

speeds = [1660, 1700, 1726, 1760]
scene = r37.scene("abradable", results=["stress"], stress_history_speeds_rad_s=speeds)
response = r37.sweep("Ref", scene, speeds, fidelity="draft")

figure, axes = plt.subplots(layout="constrained")
for speed, history in response.max_von_mises_history.sel(region="airfoil").groupby("history_speed"):
    axes.semilogy(history.revolution, 1e-9 * history.squeeze(), label=f"{speed:.0f} rad/s")
axes.axhline(1e-9 * response.yield_stress.item(), color="0.3", linestyle="--", label="yield stress")
axes.set(xlabel="revolution", ylabel="largest von Mises stress (GPa)", ylim=(1e-3, None))
axes.legend()
