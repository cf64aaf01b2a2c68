"""A run with a name takes reduced models over from the results of a run without one, where they are made of the same."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from overlays import overlay
from workflow_runs import snakemake

from r37core.config import command_line_document
from r37core.dataset_file import read_dataset, recipe_of, taken_over, write_dataset
from r37core.plans.structure_plan import Structure
from r37core.product.reading import read_settings


def test_a_recipe_is_of_contents_and_values(tmp_path):
    first, same, other = (tmp_path / name for name in ("a", "b", "c"))
    first.write_text("mesh")
    same.write_text("mesh")
    other.write_text("another mesh")
    recipe = recipe_of([first], {"density": 1.0}, "code")
    assert recipe_of([same], {"density": 1.0}, "code") == recipe
    different = [
        ([other], {"density": 1.0}, "code"),
        ([first], {"density": 2.0}, "code"),
        ([first], {"density": 1.0}, "edited"),
    ]
    assert len({recipe, *(recipe_of(*one) for one in different)}) == 4


def test_only_a_sound_file_of_the_same_recipe_is_taken_over(tmp_path):
    file, copy = tmp_path / "rom.nc", tmp_path / "copy.nc"
    assert not taken_over("one", None, copy)
    assert not taken_over("one", file, copy)
    write_dataset(xr.Dataset({"mass": ("row", np.arange(1000.0))}), file, {"recipe": "one"})
    assert not taken_over("two", file, copy)
    assert not copy.exists()
    assert taken_over("one", file, copy)
    assert copy.read_bytes() == file.read_bytes()
    copy.unlink()
    content = file.read_bytes()
    place = content.index(np.arange(500.0, 504.0).tobytes())
    file.write_bytes(content[:place] + b"\xff" + content[place + 1 :])
    assert not taken_over("one", file, copy)
    file.write_text("no dataset")
    assert not taken_over("one", file, copy)
    assert not copy.exists()


def test_only_runs_with_a_name_look_for_others(config_copy):
    wildcards = SimpleNamespace(blade="Ref", tip_line="camber")
    assert Structure(read_settings(config_copy)).made_before(wildcards)["file"] is None
    named = read_settings(config_copy, command_line_document({"run": {"name": "thin"}}))
    assert named.results.as_posix() == "results/runs/thin"
    assert Structure(named).made_before(wildcards)["file"] == "results/Ref/rom_camber.nc"


@pytest.mark.slow
def test_a_run_with_a_name_reduces_nothing_again(structure_copy):
    for name, made in (("same", "copy of results/Ref/rom_pressure_edge.nc"), ("heavy", "independent at")):
        if name == "heavy":
            overlay(structure_copy, "blades.yaml", "Ref: { material: { density_kg_m3: 8001 } }")
        file = f"results/runs/{name}/Ref/rom_pressure_edge.nc"
        snakemake(structure_copy, file, "--cores", "1", "--config", f"run={{name: {name}}}")
        assert made in (structure_copy / f"logs/runs/{name}/Ref/reduced_model_pressure_edge.log").read_text()
    before, same, heavy = (
        read_dataset(structure_copy / f"results/{folder}Ref/rom_pressure_edge.nc")
        for folder in ("", "runs/same/", "runs/heavy/")
    )
    xr.testing.assert_identical(before, same)
    assert not before["mass"].equals(heavy["mass"])
