"""A blade on its disc: the example of a blisk runs, at a small level, and energies balance; the workflow meshes a disc."""

import numpy as np
import pytest
from workflow_runs import snakemake

import r37
from r37core.mesh.mesh_files import read_vtu


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


@pytest.mark.slow
def test_the_workflow_puts_a_disc_under_a_blade(project):
    """Its mesh stands on the disc, and one that does not fit is refused with the key."""
    disc = "disc: {{ web_m: 0.008, rim_m: 0.01, bore_radius_m: 0.08, sectors: {} }}"
    blades = "".join(f"{name}: {{ base: Ref, {disc.format(number)} }}\n" for name, number in (("OnDisc", 36), ("Many", 400)))
    with open(project / "config/blades.yaml", "a") as stream:
        stream.write(f"\n{blades}")
    chosen = ["--cores", "1", "--config", "blades=[OnDisc,Many]"]
    snakemake(project, "results/OnDisc/mesh.vtu", *chosen)
    radius = np.hypot(*read_vtu(project / "results/OnDisc/mesh.vtu").points[:, :2].T)
    assert radius.min() == pytest.approx(0.08)
    told = snakemake(project, "results/Many/mesh.vtu", *chosen, check=False)
    assert "Many.disc: found bore_radius_m 0.08, web_m 0.008 and 400 sectors; allowed" in told
