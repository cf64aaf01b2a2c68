"""Costs: what a run says before it begins, the parts of its time, and how it grows."""

from conftest import CHECKOUT
from evidence import speed
from evidence.plan import Named
from evidence.tables import read_table

ESTIMATE = "part,simulations,core_min\njobs,10,0.01\ntime integration,10,0.02\nfiles,10,0.005\n"


def test_what_is_said_before_and_what_happens_stand_beside_each_other(monkeypatch, tmp_path):
    """Simulations of all stages are added: each counts its own alone."""
    said = "simulations: sweep about 100, as results ask (26 at least), run_ups 7\nCPU time: about 2.5 minutes; as"
    told = iter([said, "simulations 9 of about 107 (Ref 9)\nsimulations 90 of about 107 (Ref 90)", "simulations 6 (Ref 6)", ""])
    monkeypatch.setattr(speed, "_snakemake", lambda *_: (next(told), 30.0))
    speed.studies(None, Named(table=tmp_path / "table.csv"), Named(studies={"sweep": ([], {})}))
    assert read_table(tmp_path / "table.csv")[1] == ["sweep", "96 (107)", *4 * ["0.5"], "2.0 (2.5)"]


def test_parts_of_a_run_add_up_and_all_that_grows_has_a_row(monkeypatch, tmp_path):
    (tmp_path / "estimate.csv").write_text(ESTIMATE)
    output = Named(table=tmp_path / "table.csv")
    speed.runs(Named(lined=tmp_path / "estimate.csv"), output, Named())
    assert read_table(output.table)[1] == ["lined", "120", "30", "60", "210"]
    monkeypatch.chdir(CHECKOUT)
    monkeypatch.setattr(speed, "RESULTS", tmp_path)
    monkeypatch.setattr(speed, "_snakemake", lambda target, keys, *_: ("", len(str(keys))))
    speed.growth(None, output, Named(dict.fromkeys(("nodes", "modes", "speeds", "blades"), (5, 5000)), configuration={}))
    rows = {row[0]: row[1:] for row in read_table(output.table)[1:]}
    assert len(rows) == 5 and rows["modes: run (ms)"] == ["5/5,000", "120/120"]
