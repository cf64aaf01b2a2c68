"""Blades that are made of the same have one reduced model, in the user's cache, whichever run or call asks for it."""

import pytest
import xarray as xr
from workflow_runs import overlay, snakemake

from r37core.base.dataset_file import read_dataset
from r37core.machine_code import kept


def test_what_cannot_be_kept_is_made_where_it_is_needed(tmp_path, monkeypatch):
    """A cache folder that cannot be written is no failure of a run; what making raises is."""
    monkeypatch.setenv("R37_CACHE", str(tmp_path / "file" / "cache"))
    (tmp_path / "file").write_text("")
    assert kept.kept_for_user("a.txt", "made of", lambda file: file.write_text("a")) is None
    monkeypatch.setenv("R37_CACHE", str(tmp_path / "cache"))
    file = kept.kept_for_user("a.txt", "made of", lambda file: file.write_text("a"))
    assert file.read_text() == "a" and file.parent == tmp_path / "cache"
    assert kept.kept_for_user("a.txt", "made of", None) == file
    with pytest.raises(ValueError, match="impossible"):
        kept.kept_for_user("a.txt", "others", lambda file: (_ for _ in ()).throw(ValueError("impossible")))


@pytest.mark.slow
def test_a_run_with_a_name_reduces_nothing_again(structure_copy, monkeypatch):
    """Nor does it where the first run had no cache, once one has made the model; another density is another model."""
    monkeypatch.setenv("R37_CACHE", str(structure_copy / "cache"))
    for name, reduced in (("first", True), ("same", False), ("heavy", True)):
        if name == "heavy":
            overlay(structure_copy, "blades.yaml", "Ref: { material: { density_kg_m3: 8001 } }")
        file = f"results/runs/{name}/Ref/rom_pressure_edge.nc"
        snakemake(structure_copy, file, "--cores", "1", "--config", f"run={{name: {name}}}")
        log = (structure_copy / f"logs/runs/{name}/Ref/reduced_model_pressure_edge.log").read_text()
        assert f"kept as {structure_copy}/cache/rom-" in log and ("independent at" in log) == reduced
    folders = ("Ref", "runs/first/Ref", "runs/same/Ref", "runs/heavy/Ref")
    files = [structure_copy / f"results/{folder}/rom_pressure_edge.nc" for folder in folders]
    before, first, same, heavy = map(read_dataset, files)
    xr.testing.assert_identical(before, first)
    xr.testing.assert_identical(first, same)
    assert not before["mass"].equals(heavy["mass"])
