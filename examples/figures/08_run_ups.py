"""Run-ups of several rates.

A faster run-up leaves less time to vibrate.
"""

import r37

about = {"crossing": {"mode": "1B", "engine_order": 4, "first": -0.015, "last": 0.07}}
rates = {f"rate-{rate}": {**about, "rate_rad_s2": rate} for rate in (100, 300, 1000, 3000)}
asked = {"run_ups": rates, "targets": "results/run_ups.nc"}
run_ups = r37.run("Ref", "abradable", **asked, fidelity="draft", cores=2)["run_ups"]

figure = r37.plot_run_ups(run_ups)
