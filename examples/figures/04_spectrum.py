"""Engine orders of the motion.

Bright spots lie on whole orders; the wear has as many lobes.
"""

import matplotlib.pyplot as plt

import r37

speeds = {"start": 900, "stop": 1800, "step": 20, "refine_to": 5}
response = r37.sweep("Ref", "abradable", speeds, fidelity="draft", results=["spectrum"], cores=2)
amplitude = 1e3 * response.amplitude.sel(engine_order=slice(0, 10))

figure, axes = plt.subplots(layout="constrained")
image = axes.pcolormesh(amplitude.speed, amplitude.engine_order, amplitude.T, norm="log", vmin=1e-3, vmax=1)
axes.set(xlabel="speed (rad/s)", ylabel="engine order")
figure.colorbar(image, label="amplitude, leading edge (mm)")
