"""3. A family of designs: how sweep changes the clearance that a blade loses as it swings.

Run it with `python examples/03_family_of_designs.py`: about three minutes on one core. The benchmark's authors found that
blades which close their gap less are the safer ones; a share of the sweep of S100 does that.
"""

import r37

family = {"sweep_percent": [0, 50, 100]}
blade = r37.blade("S100", name="Sweep", kinematics="quadratic", contact="patches", vary=family)
results = r37.run(blade, "material_abradable", [1680, 1700], fidelity="draft", cores=2)

designs = results.tables["designs"].set_index("sweep_percent")
for share, row in designs.iterrows():
    loss, stress = 1e3 * row.clearance_loss_1b_m, 1e-9 * row.largest_median_stress_pa
    print(f"{share:g}% of the sweep: 1B at {row.frequency_1b_hz:.0f} Hz, loses {loss:.2f} mm of clearance, {stress:.2f} GPa")
assert list(results.ranking.columns[:3]) == ["blade", "scene", "rank"]
assert designs.clearance_loss_1b_m[0] > designs.clearance_loss_1b_m[50] > designs.clearance_loss_1b_m[100]
