"""5. Tolerances: how far a peak goes when friction and clearance are known to percents only.

Run it with `python examples/05_tolerances.py`: about a minute on one core. Members of the scene are drawn, and run at the same
speeds as the blade itself, on patches of the tip and with large displacements, as a decision needs.
"""

import r37

spread = {"friction.coefficient": {"uniform_percent": 10}, "casing.clearance_m": {"uniform_percent": 5}}
tolerances = {"of_scenes": spread, "members": 4}
speeds = {"start": 1680, "stop": 1760, "step": 20}
blade = r37.blade("Ref", kinematics="quadratic", contact="patches", name="Large")
results = r37.run(blade, "material_abradable", [speeds], tolerances=tolerances, fidelity="draft", cores=2)
members = results["tolerances"].isel(blade=0, scene=0)

stress = 1e-9 * members.largest_stress
print("members:", ", ".join(f"{number:.2f} GPa" for number in stress.values))
low, middle, high = 1e-9 * members.max_von_mises_ever_quantile.max("speed")
print(f"the peak has {low:.2f} to {high:.2f} GPa in nine tenths of them, {middle:.2f} in the middle")
assert stress.min() <= low < middle < high <= stress.max()
