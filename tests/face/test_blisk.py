"""The example of a blisk runs, at a small level, and energies balance."""

import pytest

import r37


@pytest.mark.slow
def test_the_blisk_runs(root):
    folder = root / "examples/blisk"
    blade = r37.blade("Blisk", file=folder / "blades.yaml")
    response = r37.simulate(blade, r37.scene("Stage", file=folder / "scenes.yaml"), 1160, fidelity="draft", results=["stress"])
    assert int(response["status"]) == 0 and abs(float(response["energy_residual_share"])) < 1e-9
    assert float(response["rms_normal"].max()) > 0.0
    campbell = r37.campbell(blade, fidelity="draft")
    first = campbell["nodal_frequency"].sel(mode="1B", speed=0.0)
    assert [round(float(first.sel(nodal_diameter=number)), 1) for number in (0, 2, 4, 9)] == [995.0, 1042.7, 972.2, 990.7]
