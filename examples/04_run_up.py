"""4. A run-up: the faster a blade crosses an interaction, the less it moves.

Run it with `python examples/04_run_up.py`: about a minute on one core. The blade is the reference, on an abradable lining, as
its first bending mode crosses engine order 4. Blade and contact are the published ones, linear and on points.
"""

import r37

about = {"crossing": {"mode": "1B", "engine_order": 4, "first": -0.015, "last": 0.07}}
rates = {"slow": {**about, "rate_rad_s2": 300}, "fast": {**about, "rate_rad_s2": 3000}}
asked = {"run_ups": rates, "targets": "results/run_ups.nc"}
run_ups = r37.run("Ref", "abradable", **asked, fidelity="draft", cores=2)["run_ups"]

largest = run_ups.maximum_normal.sel(tip_point="leading_edge").max("revolution")
peaks = dict(zip(run_ups.run_up.values, largest.values, strict=True))
for name, rate in zip(run_ups.run_up.values, run_ups.rate.values, strict=True):
    print(f"at {rate:.0f} rad/s2: up to {1e3 * peaks[name]:.2f} mm towards the casing")
assert 0.0 < peaks["fast"] < peaks["slow"]
