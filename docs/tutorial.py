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
# blade, and vibration, stress and wear grow: an interaction. This notebook takes a blade that nobody has computed yet,
# the reference blade swept forward by ten degrees, and finds the speed at which it fares worst. It needs neither
# Snakemake nor a configuration of its own, and takes a few minutes on one core.
#
# Lengths are in m, speeds in rad/s, stress in Pa, unless an axis says otherwise.

# %%
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt
import numpy as np
from IPython.display import Image, display

from r37core.config import command_line_document, plain, si_fields
from r37core.figures import style
from r37core.product.reading import read_settings
from r37core.units import RPM

# %matplotlib inline

ROOT = Path.cwd() if (Path.cwd() / "config").exists() else Path.cwd().parent
settings = read_settings(ROOT, command_line_document({"fidelity": "draft"}))
print(f"level {settings.fidelity_name}: {settings.fidelity.mesh.nodes} nodes")


# %% [markdown]
# ## The shape
#
# A blade is a table of profiles, arcs of circles on cones, and what moves them: here one angle. In `config/blades.yaml`
# the same blade reads
#
# ```yaml
# Mine:
#   base: Ref
#   chordwise_sweep_deg: 10
# ```

# %%
reference = settings.blades["Ref"]
definition = replace(reference.definition, name="Mine", chordwise_sweep_angle=np.radians(10.0))
blade = definition.build(round_edges=settings.structure.edges == "round")

# %% [markdown]
# ## Mesh, matrices, reduced model
#
# The mesh has wedges of 15 nodes. Its matrices carry the stiffening of the centrifugal load, and a Craig-Bampton
# reduction leaves about a hundred coordinates, among them eight nodes along the tip where the blade can touch.

# %%
from r37core.fem.matrices import assemble
from r37core.fem.mesh_quality import mesh_quality
from r37core.figures.blade_shapes import draw_blade_shapes
from r37core.mesh.generate import generate_mesh
from r37core.mesh.mesh_files import write_vtu
from r37core.rom.reduce import reduce_blade

level = settings.fidelity
mesh = generate_mesh(blade, nodes=level.mesh.nodes, layers=level.mesh.layers, tip_elements=level.mesh.tip_elements)
model = reduce_blade(mesh, assemble(mesh, reference.material), settings.reduction_choice("Ref"))
print(f"{mesh.points.shape[0]} nodes, {model.size} coordinates")

with TemporaryDirectory() as folder:
    file, picture = Path(folder) / "mesh.vtu", Path(folder) / "mesh.png"
    write_vtu(mesh, file, mesh_quality(mesh).per_element)
    draw_blade_shapes({"Mine": file}, picture)
    display(Image(picture.read_bytes()))

# %% [markdown]
# ## Where it could resonate
#
# The Campbell diagram: a mode is excited where its frequency is a whole multiple, an engine order, of the speed. A
# casing with two lobes excites even orders to begin with; wear adds others. To the right: how the gap at the leading
# edge changes while the blade swings freely. A blade whose gap closes less is the safer one.

# %%
from r37core.figures.campbell_diagram import draw_campbell
from r37core.results.campbell_dataset import campbell_dataset

campbell = campbell_dataset(
    model,
    maximum_speed=settings.structure.maximum_speed_rad_s,
    tip_line="pressure_edge",
    **si_fields(settings.config.campbell),
)
draw_campbell(campbell, "Mine")
crossings = campbell["crossing_speed"].sel(mode="1B").to_series().dropna()
print(crossings.round(1).to_string())

# %% [markdown]
# ## One simulation
#
# The scene `abradable` is the benchmark's: the casing closes in and wears into a lining. One run is one speed. It gives
# the rms of the leading edge's motion, the wear of the lining, and the largest stress, here of each revolution.

# %%
from r37core.rom.reduced_model import contact_model
from r37core.stress.recovery import stress_operator
from r37core.time_integration.speed_run import run_speed

scene = settings.scenes["abradable"].scene
contact = contact_model(model, "pressure_edge")
recovered = stress_operator(model, reference.material)
kept = {key: plain(level.time_integration)[key] for key in ("spectrum_highest_order", "wear_angles")}


def simulate(speed, whole_run=False):
    """One speed: the run, and the largest stress of each revolution, from the last half on or of all."""
    choice = settings.integration_choice("Ref", "abradable", speed)
    choice = replace(choice, snapshot_revolutions=choice.revolutions if whole_run else choice.revolutions_in_statistic)
    run = run_speed(contact, speed, scene, choice, ["stress", "wear"], **kept, stress=recovered)
    return run, run["revolution_von_mises"]


run, stress = simulate(1600.0)
normal, _, tangential = run["rms"][0]
print(f"1600 rad/s: rms {1e3 * normal:.3f} mm to the casing, {1e3 * tangential:.3f} mm tangential, {1e-9 * stress[-1]:.3f} GPa")

# %% [markdown]
# ## All speeds, then a closer look
#
# First every 20 rad/s. Contact stiffens the blade, so its answer peaks a few percent above a crossing, and ends in a
# drop within a few rad/s: around the largest stress of the first pass, every 2 rad/s.

# %%
found = {}


def sweep(speeds):
    for speed in speeds:
        if speed not in found:
            run, stress = simulate(float(speed))
            found[speed] = (run["rms"][0][0], run["rms"][0][2], stress[-1], float(run["max_wear"]))


def worst():
    return max(found, key=lambda speed: found[speed][2])


sweep(np.arange(750.0, 2000.1, 20.0))
first = worst()
sweep(np.arange(first - 18.0, first + 18.1, 2.0))
speed = worst()
nearest = crossings[crossings < speed].index[0]
print(f"{len(found)} runs; the largest stress at {speed:g} rad/s ({speed * RPM:.0f} rpm), {1e-9 * found[speed][2]:.2f} GPa")
print(f"{100 * (speed / crossings[nearest] - 1):.1f}% above the crossing of 1B with engine order {nearest}")

# %%
speeds = np.array(sorted(found))
values = np.array([found[one] for one in speeds])
_, (above, below) = plt.subplots(2, 1, figsize=(style.PAGE, 4.6), sharex=True)
above.plot(speeds, 1e3 * values[:, 0], ".-", markersize=3, label="normal to the casing")
above.plot(speeds, 1e3 * values[:, 1], ".-", markersize=3, label="tangential")
above.set_ylabel("rms, leading edge (mm)")
above.legend()
below.plot(speeds, 1e-9 * values[:, 2], ".-", markersize=3)
below.axhline(1e-9 * reference.material.yield_stress, color="0.3", linestyle="--", linewidth=0.9)
below.set(xlabel="speed (rad/s)", ylabel="largest von Mises (GPa)")
for order, crossing in crossings[crossings > 750.0].items():
    above.axvline(crossing, color="0.5", linestyle=":", linewidth=0.8)
    above.annotate(f"{order}", (crossing, 0.9), xycoords=("data", "axes fraction"), fontsize=7)
style.rpm_axis(above)

# %% [markdown]
# Dotted: crossings of 1B with engine orders; dashed: yield stress. Beyond yield the linear model can say where the
# blade is in danger and how wide the range is, no more how far it swings.
#
# ## The worst speed in detail

# %%
run, history = simulate(speed, whole_run=True)
first_yield = np.argmax(history > reference.material.yield_stress) + 1
print(f"yield is first passed in revolution {first_yield} of {len(history)}; wear up to {1e3 * float(run['max_wear']):.2f} mm")

figure = plt.figure(figsize=(style.PAGE, 2.8))
left, right = figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2, projection="polar")
left.semilogy(np.arange(1, len(history) + 1), 1e-9 * history)
left.axhline(1e-9 * reference.material.yield_stress, color="0.3", linestyle="--", linewidth=0.9)
left.set(xlabel="revolution", ylabel="largest von Mises (GPa)", ylim=(1e-3, None))
angle = 2.0 * np.pi * np.arange(len(run["wear"])) / len(run["wear"])
right.plot(angle, 1e3 * run["wear"])
right.set_title("wear round the casing (mm)")
plt.show()

# %% [markdown]
# As many lobes are worn into the lining as the engine order has.
#
# ## And on
#
# - The whole of it at full accuracy, in both scenes, with adaptive speed sampling: put the blade into
#   `config/blades.yaml` and run `make all_blades`. Nothing of the other blades is run again.
# - `results/explorer.html` shows all blades linked, `make report` makes one file of it.
# - A family instead of one blade: `chordwise_sweep_deg` under `vary`, in [blades.md](blades.md).
# - A mesh or matrices of another program: [your_blade.md](your_blade.md).
