"""Wear of the lining.

At each interaction the lining has as many worn lobes as the engine order.
"""

import matplotlib.pyplot as plt

import r37

speeds = [1000, 1264, 1726]
response = r37.sweep("Ref", "abradable", speeds, fidelity="draft", results=["wear"])

figure, panels = plt.subplots(1, 3, figsize=(9, 3.4), layout="constrained", subplot_kw={"projection": "polar"})
for axes, speed in zip(panels, speeds, strict=True):
    axes.plot(response.angle, 1e3 * response.wear.sel(speed=speed))
    axes.set_rticks([1, 2])
    axes.set_title(f"wear at {speed} rad/s (mm)")
