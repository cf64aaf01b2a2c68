# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # From a blade of your own to its worst interaction
#
# A compressor blade spins inside a casing that slowly becomes oval. At some speeds the rub locks on to a mode of the
# blade, and vibration, stress and wear grow: an interaction. This notebook takes a blade that is none of the benchmark's
# seven, the reference blade swept forward by seven degrees, and finds the worst speed of a range. It calls `r37`
# alone, needs no folder and no configuration of its own, and takes two minutes on two cores. Motions are large and contact
# acts on patches, as decisions need; the level is `draft`, which they do not: it shows the calls and decides nothing.
#
# Lengths are in m, speeds in rad/s, stress in Pa, unless an axis says otherwise.

# %%
import matplotlib.pyplot as plt
import numpy as np

import r37

# %matplotlib inline

# %% [markdown]
# ## The blade
#
# A blade is a table of profiles, arcs of circles on cones, and what moves them: here one angle. In `config/blades.yaml`
# the same blade reads
#
# ```yaml
# Mine:
#   base: Ref
#   kinematics: quadratic
#   contact: patches
#   chordwise_sweep_deg: 7
# ```
#
# All calls below are at level `draft`, with 5,000 nodes; [accuracy.md](accuracy.md) says what that costs in accuracy.

# %%
large = {"kinematics": "quadratic", "contact": "patches"}
mine = r37.blade("Ref", chordwise_sweep_deg=7, name="Mine", **large)
draft = {"fidelity": "draft"}
print(r37.blades(), "and", mine.label)

# %% [markdown]
# ## Where it could resonate
#
# The Campbell diagram: a mode is excited where its frequency is a whole multiple, an engine order, of the speed. A
# casing with two lobes excites even orders to begin with; wear adds others. To the right: how the gap at the leading
# edge changes while the blade swings freely. A blade whose gap closes less is the safer one.

# %%
campbell = r37.campbell(mine, **draft)
figure = r37.plot_campbell(campbell)
crossings = campbell.crossing_speed.sel(mode="1B").to_series().dropna()
print(crossings.round(1).to_string())

# %% [markdown]
# ## One simulation
#
# In the scene `material_abradable` the casing closes in, and the tip wears into a lining. One run is one speed. It gives
# the rms of the leading edge's motion, the wear of the lining, and the largest stress.

# %%
run = r37.simulate(mine, "material_abradable", 1600, **draft)
edge = run.sel(tip_point="leading_edge")
print(f"rms {1e3 * edge.rms_normal:.3f} mm to the casing, {1e3 * edge.rms_tangential:.3f} mm tangential")
print(f"largest stress {1e-9 * run.max_von_mises_ever.sel(region='airfoil'):.3f} GPa, wear up to {1e3 * run.max_wear:.2f} mm")

# %% [markdown]
# ## A range of speeds
#
# A speed is dangerous where the stress passes yield in any revolution, before the motion, a force or the heat leaves what the
# model can follow. It is unknown where they leave it first. With `refine_to` the speeds are sampled adaptively: here about the
# crossing of engine order 4 every 20 rad/s, and down to 10 where something happens.

# %%
speeds = {"start": 1500, "stop": 1800, "step": 20, "refine_to": 10}
response = r37.sweep(mine, "material_abradable", speeds, cores=2, **draft)
inside = response.max_von_mises_inside.sel(region="airfoil")
speed = inside.idxmax("speed").item()
below, unknown, dangerous = (int((response.yield_danger.sel(region="airfoil") == kind).sum()) for kind in range(3))
print(f"{response.sizes['speed']} runs: {dangerous} dangerous, {unknown} unknown, {below} below yield")
rpm = 30 / np.pi * speed
print(f"the largest stress inside the model at {speed:.0f} rad/s ({rpm:.0f} rpm), {1e-9 * inside.max().item():.2f} GPa")
order = int((crossings - speed).abs().idxmin())
print(f"{100 * (speed / crossings[order] - 1):+.1f}% from the nearest crossing of 1B, with engine order {order}")
figure = r37.plot_response(response, campbell)

# %% [markdown]
# The material stays elastic: beyond yield a stress marks a speed, and is no prediction.
#
# ## The worst speed in detail
#
# A scene says what is kept of a run. Here it keeps the largest stress of every revolution of this speed.

# %%
kept = r37.scene("material_abradable", results=["stress", "wear"], stress_history_speeds_rad_s=[speed])
worst = r37.sweep(mine, kept, [speed], **draft)
history = worst.max_von_mises_history.sel(history_speed=speed, region="airfoil")
first, left = (worst[name].values.flat[0] for name in ("first_yield_revolution", "exit_revolution"))
print(f"yield is passed first in revolution {first:.0f} of {len(history)}, the model is left in {left:.0f} (nan: never)")

figure = plt.figure(figsize=(7, 2.8), layout="constrained")
left, right = figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2, projection="polar")
left.semilogy(history.revolution, 1e-9 * history)
left.axhline(1e-9 * worst.yield_stress.item(), color="0.3", linestyle="--", linewidth=0.9)
left.set(xlabel="revolution", ylabel="largest von Mises (GPa)", ylim=(1e-3, None))
right.plot(worst.angle, 1e3 * worst.wear.isel(speed=0))
right.set_title("wear round the casing (mm)")
plt.show()

# %% [markdown]
# Dashed is the yield stress.
#
# ## A run-up through it
#
# A rotor does not stay at its worst speed. Here the speed rises through it, at two rates.

# %%
about = {"crossing": {"mode": "1B", "engine_order": order, "first": -0.05, "last": 0.05}}
rates = {"slow": {**about, "rate_rad_s2": 100}, "fast": {**about, "rate_rad_s2": 1000}}
run_ups = r37.run(mine, "material_abradable", run_ups=rates, targets="results/run_ups.nc", cores=2, **draft)["run_ups"]
for name, stress in zip(run_ups.run_up.values, run_ups.max_von_mises.max("revolution").values, strict=True):
    print(f"{name}: up to {1e-9 * stress:.2f} GPa")
figure = r37.plot_run_ups(run_ups)

# %% [markdown]
# ## Is it better than the reference blade?
#
# Blades are ranked by the bracket from their dangerous speeds to these and the unknown ones; they share a rank where brackets
# overlap: then these runs cannot tell.

# %%
reference = r37.blade("Ref", name="Reference", **large)
results = r37.run([reference, mine], "material_abradable", speeds, cores=2, **draft)
print(results.ranking[["blade", "rank", "length_dangerous_rad_s", "length_unknown_rad_s"]].to_string(index=False))

# %% [markdown]
# ## And on
#
# - In both scenes, at full accuracy: put the blade into `config/blades.yaml` and run `make all_blades`. Nothing of the other
#   blades is run again.
# - `results/explorer.html` shows all blades linked, `r37 report` makes one file of it.
# - A family instead of one blade: `r37.blade(..., vary={"chordwise_sweep_deg": [0, 5, 10]})`. Ten figures, each with its
#   code: [gallery.md](gallery.md).
# - A mesh or matrices of another program: [your_blade.md](your_blade.md).
