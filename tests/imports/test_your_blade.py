"""The worked example of docs/your_blade.md, and imported blades through the workflow."""

import re
import runpy
import shlex
import shutil

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from import_defaults import assert_same_sets
from stubbed_runs import copy_stubbed, edit
from workflow_runs import copy_finished, copy_project, overlay, planned_outputs, snakemake

from r37imports.imported_entry import MeshEntry
from r37imports.importing.import_mesh import import_mesh
from r37imports.refusal import ImportRefused


def blocks(root, language):
    return re.findall(rf"```{language}\n(.*?)```", (root / "docs/your_blade.md").read_text(), re.DOTALL)


@pytest.fixture(scope="module")
def drawn(root, tmp_path_factory):
    """The folder in which the page's drawing was made."""
    folder = tmp_path_factory.mktemp("drawn")
    (folder / "draw.py").write_text(*blocks(root, "python"))
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        runpy.run_path("draw.py")
    return folder


def with_example(root, drawn, to, copy):
    """A project with the example's blade instead of the benchmark's, and a short sweep over its crossing with order 6."""
    copy(root, to)
    shutil.copytree(drawn / "meshes", to / "meshes")
    with open(to / "config/blades.yaml", "a") as stream:
        stream.write("\n" + blocks(root, "yaml")[0])
    overlay(to, "config.yaml", "{ blades: [Fan], speeds: [1400, 1475, 1550] }")
    return to


def told(text):
    """A message without the line breaks of a page, and without digits, which are another mesh generator's too."""
    return re.sub(r"[\d.]+", "#", " ".join(text.split()))


def test_the_page_shows_the_refusal_as_it_is(root, drawn):
    """With another rotation and rule for the tip; its lines make the entry that is accepted."""
    page = (root / "docs/your_blade.md").read_text()
    (shown,) = re.findall(r"<!-- refusal -->\n```text\n(.*?)```", page, re.DOTALL)
    (entry,) = yaml.safe_load(blocks(root, "yaml")[0]).values()
    wrong = entry | {"rotation": "negative", "tip": yaml.safe_load(re.search(r"`tip: (\{ r_at_least_m: .*? \})`", page)[1])}
    with pytest.raises(ImportRefused) as refusal:
        import_mesh(MeshEntry.model_validate(wrong).source(drawn), drawn)
    assert told(str(refusal.value)) == told(shown)
    lines = yaml.safe_load("\n".join(line for line in shown.splitlines() if line.startswith("  ")))
    again, _ = import_mesh(MeshEntry.model_validate(wrong | lines).source(drawn), drawn)
    ours, _ = import_mesh(MeshEntry.model_validate(entry).source(drawn), drawn)
    assert_same_sets(again, ours, "root", "tip", "tip_pressure_edge")


@pytest.mark.slow
def test_the_example_runs_to_its_interactions(root, drawn, tmp_path):
    project = with_example(root, drawn, tmp_path, copy_project)
    overlay(project, "fidelity.yaml", "tiny: { time_integration: { revolutions: 60 } }")
    scenes = yaml.safe_load((root / "config/scenes.yaml").read_text())
    overlay(project, "scenes.yaml", yaml.safe_dump({"material_abradable": scenes["material_abradable"]}))
    command = re.search(r"^snakemake (.*)$", blocks(root, "sh")[0], re.MULTILINE)[1]
    said = snakemake(project, *shlex.split(command))
    assert re.search(
        r"Fan.mesh: 0\.\d+ m long and 0\.\d+ m wide along the axis, "
        r"radius of the tip 0.2\d* m at the leading and 0.2\d* m at the trailing edge, of the root 0.2",
        said,
    )
    table = pd.read_csv(project / "results/summary.csv")
    assert set(table["blade"]) == {"Fan"}
    with xr.open_dataset(project / "results/campbell.nc") as dataset:
        crossing = dataset["crossing_speed"].sel(blade="Fan", mode="1B", engine_order=6).item()
        assert crossing == pytest.approx(1486, rel=0.005)
        assert dataset["smallest_mac"].min() > 0.99
    with xr.open_dataset(project / "results/stress.nc") as dataset:
        assert (dataset["max_von_mises_last_revolution"] > 0.0).all()
    for name in ("campbell_Fan", "response_Fan", "blades", "wear_Fan__material_abradable"):
        assert (project / f"results/figures/{name}.png").exists()


@pytest.fixture(scope="module")
def stubbed(root, drawn, tmp_path_factory):
    folder = with_example(root, drawn, tmp_path_factory.mktemp("stubbed"), copy_stubbed)
    snakemake(folder, "all_blades", "exports", "--cores", "2")
    return folder


@pytest.fixture
def project(stubbed, tmp_path):
    return copy_finished(stubbed, tmp_path / "project")


@pytest.mark.slow
class TestWhatRunsAgain:
    """Jobs only touch their outputs here."""

    def test_nothing_after_a_run_at_another_place_or_on_another_line(self, project, tmp_path):
        assert planned_outputs(project, "all_blades", "exports") == {}
        ran = {file.name for file in (project / "results/Fan").iterdir()}
        assert {"mesh.msh", "mesh.vtu"} <= ran
        assert "geometry.nc" not in ran
        edit(project, "blades.yaml", "Fan:", "# a comment\n\nFan:")
        project.rename(tmp_path / "elsewhere")
        assert planned_outputs(tmp_path / "elsewhere") == {}

    def test_another_level_keeps_the_mesh_and_an_edited_mesh_is_read_again(self, project):
        assert "imported_mesh" not in planned_outputs(project, "all_blades", "--config", "fidelity=draft")
        file = project / "meshes/fan.msh"
        file.write_bytes(file.read_bytes() + b"\n")
        jobs = planned_outputs(project)
        assert jobs["imported_mesh"] == {"Fan/mesh.msh"}
        assert "simulate" in jobs

    def test_a_key_behind_the_mesh_and_one_of_the_mesh(self, project):
        overlay(project, "blades.yaml", "Fan: { stress_regions: { airfoil: { excluded_layers: 2 } } }")
        jobs = planned_outputs(project)
        assert "imported_mesh" not in jobs
        assert jobs["reduced_model"] == {"Fan/rom_pressure_edge.nc"}
        overlay(project, "blades.yaml", "Fan: { rotor_axis: [1, 0, 0.0001] }")
        assert planned_outputs(project)["imported_mesh"] == {"Fan/mesh.msh"}


@pytest.mark.slow
def test_matrices_run_to_the_same_response(root, drawn, tmp_path):
    """The reduced matrices that `snakemake exports` writes, given back as a blade of their own, beside the mesh.

    On points, whose first is the leading edge that rms is of: the first patch is a mean. Matrices are linear.
    """
    project = with_example(root, drawn, tmp_path, copy_project)
    overlay(project, "blades.yaml", "Fan: { contact: points, kinematics: linear }")
    snakemake(project, "results/exports/Fan/matrices", "--cores", "1")
    shutil.copytree(project / "results/exports/Fan/matrices", project / "meshes/elsewhere")
    (given,) = yaml.safe_load(next(block for block in blocks(root, "yaml") if "matrices:" in block)).values()
    # matrices are written in the blade's frame
    given |= {"length_unit": "m", "rotor_axis": [0, 0, 1], "radial": [1, 0, 0], "rotation": "negative"}
    with open(project / "config/blades.yaml", "a") as stream:
        stream.write("\n" + yaml.safe_dump({"FromElsewhere": given}))
    overlay(project, "config.yaml", "blades: [Fan, FromElsewhere]")
    files = [f"results/{name}" for name in ("rms.nc", "stress.nc", "figures/response_FromElsewhere.png")]
    snakemake(project, *files, "--cores", "1", "--config", "speeds=[1500]")
    with xr.open_dataset(project / "results/rms.nc") as dataset:
        ours, theirs = (dataset["rms_normal"].sel(blade=blade).values for blade in ("Fan", "FromElsewhere"))
        np.testing.assert_allclose(theirs, ours, rtol=1e-6)
    with xr.open_dataset(project / "results/stress.nc") as dataset:
        assert list(dataset["blade"].values) == ["Fan"]
    assert (project / files[-1]).exists()


@pytest.mark.slow
def test_a_refusal_names_its_line_before_anything_long(root, drawn, tmp_path):
    project = with_example(root, drawn, tmp_path, copy_project)
    file = project / "config/blades.yaml"
    lines = file.read_text().splitlines()
    line = max(i for i, text in enumerate(lines) if text.startswith("  root: "))
    lines[line] = "  root: clamp"
    file.write_text("\n".join(lines) + "\n")
    said = snakemake(project, "all_blades", "--cores", "1", check=False)
    place = f"config/blades.yaml:{line + 1}: Fan.root: meshes/fan.msh"
    assert f"rule imported_mesh: {place}: root: found no set 'clamp'; with length_unit" in said
    assert not list((project / "results/Fan").glob("*"))
