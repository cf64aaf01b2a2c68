"""The last lines of a finished run, and those on its extensions: what was found and the file to look at."""

import os
import sys
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from r37core.base.io import function_named
from r37core.plans.extension import Extension
from r37core.plans.sweep_plan import Sweep
from r37core.product.closing import closing_lines
from r37core.product.extensions import EXTENSIONS
from r37core.product.remarks import line_of_extension
from r37core.results.closing import lining_texts

HEAD = "blade,scene,mode,engine_order,length_dangerous_rad_s,largest_stress_inside_pa,largest_stress_over_yield,"
HEAD += "largest_stress_speed_rad_s"
ROWS = ("Ref,abradable,1B,7,0.7,8.56e+09,6.2,838", "S50,abradable,,4,0.4,9.5e+09,6.88,1686")
ROWS += ("Ref,direct,1T,9,0,1e+09,0.7,1344", "L50,direct,,2,,,,")


def written(folder, *rows, columns="", time=1000.0):
    """A folder with a summary, which may have more columns."""
    (folder / "summary.csv").write_text("\n".join([HEAD + columns, *rows]) + "\n")
    os.utime(folder / "summary.csv", (time, time))
    return folder


def last_lines(folder, *rows, **columns):
    """Last lines of a run with these interactions."""
    return closing_lines(written(folder, *rows, **columns), 400.0, 500.0)


def test_found_where_and_how_long(tmp_path):
    assert closing_lines(written(tmp_path, *ROWS), 400.0, 1210.0)[1] == f"look at {tmp_path}/summary.csv"
    (tmp_path / "explorer.html").touch()
    (tmp_path / "figures").mkdir()
    found, remark, where, took = closing_lines(written(tmp_path, *ROWS), 400.0, 1210.0, ["contact acts on points"])
    assert remark == "contact acts on points"
    what, worst = found.split("; ")
    assert what == "found 4 interactions, 2 of them dangerous (above yield inside the model's limits)"
    assert worst == (
        "the largest stress 9.50 GPa, 6.88 times yield before the model is left, S50 in abradable at 1686 rad/s "
        "(engine order 4)"
    )
    assert where == f"look at {tmp_path}/explorer.html (any browser), {tmp_path}/summary.csv, {tmp_path}/figures/"
    assert took == "took 13 min 30 s"
    for seconds, text in {59.4: "59 s", 12_345.0: "3 h 25 min"}.items():
        assert closing_lines(written(tmp_path), 0.0, seconds)[2] == f"took {text}"
    assert "(1B/7)" in last_lines(tmp_path, ROWS[0])[0]
    # a combination, at a peak that two speeds show
    rows = [f"Fan,bare,7-5,6,0.7,1e+09,1.1,470,{note}" for note in ("not resolved: one or two speeds", "")]
    said = last_lines(tmp_path, *rows, columns=",note")[0]
    assert "2 of them dangerous (above yield inside the model's limits), 1 not resolved, as one" in said and "(7-5/6)" in said


def test_more_columns_say_more(tmp_path):
    """None above yield, the linings that are worn through, and the digits that a range bears."""
    said = last_lines(tmp_path, ROWS[2])[0]
    assert said == (
        "found 1 interaction, none of them dangerous (above yield inside the model's limits); "
        "the largest stress 1.00 GPa, 0.7 times yield before the model is left, Ref in direct at 1344 rad/s (1T/9)"
    )
    assert last_lines(tmp_path, ROWS[3])[0] == "found 1 interaction"
    # the worst is that of the largest share of its own yield; one that leaves the model first is unknown
    said = last_lines(
        tmp_path, "Fan,bare,,2,0.5,9e8,1.2,500,0", "Ref,bare,,2,0,1e9,0.7,500,4", columns=",length_unknown_rad_s"
    )[0]
    assert ", 1 of them dangerous (above yield inside the model's limits), 1 unknown (these are left first); " in said
    assert "the largest stress 0.90 GPa, 1.2 times yield before the model is left, Fan" in said
    rows = [f"{row},{share}" for row, share in zip(ROWS, ("0.2", "0", "", ""), strict=True)]
    said = last_lines(tmp_path, *rows, columns=",worn_through_share")[0]
    assert " inside the model's limits), 1 with the lining worn through to the casing; the largest" in said
    columns = ",largest_stress_inside_pa_low,largest_stress_inside_pa_median,largest_stress_inside_pa_high"
    for ends, said in ((",2.02e9,8.6e9,1.41e10", "9 GPa (2 to 14 in nine tenths of the members)"), (",,,", "8.56 GPa")):
        assert (
            f"the largest stress {said}, 6.2 times yield before the model is left, Ref"
            in last_lines(tmp_path, ROWS[0] + ends, columns=columns)[0]
        )


def test_best_and_worst_blade_are_named_and_what_may_be_missed(tmp_path):
    head = "blade,scene,rank_lowest,rank_highest,length_dangerous_rad_s,length_unknown_rad_s,largest_gap_rad_s\n"
    rows = ["S100,lined,1,1,13.2,0,20\n", "Ref,lined,2,2,70.6,0,20\n"]
    rows += ["Ref,direct,1,1,47.1,0,10\n", "S100,direct,2,2,854.2,0,10\n"]
    (tmp_path / "ranking.csv").write_text(head + "".join(rows))
    lined, direct, missed = last_lines(tmp_path, *ROWS)[1:4]
    assert lined.startswith("lined: S100 is dangerous at the fewest speeds (13 rad/s), Ref is at the most (71 rad/s); ")
    assert direct.startswith("direct: Ref is dangerous at the fewest speeds (47 rad/s), S100 is at the most (854 rad/s); ")
    assert missed == "speeds lie up to 20 rad/s apart: a narrower interaction between them may be missed"
    # of those that cannot be told apart all are named, also where one overlaps both ends
    rows = [
        "A,x,1,2,40,0,0",
        "B,x,1,2,40,5,0",
        "A,y,1,2,0,0,0",
        "B,y,1,2,5,0,0",
        "C,y,3,3,9,0,0",
        *(f"D{n},z,1,12,0,0,0" for n in range(12)),
        "A,u,1,2,5,0,0",
        "B,u,1,3,5,20,0",
        "C,u,2,3,22,1,0",
    ]
    (tmp_path / "ranking.csv").write_text(head + "\n".join(rows) + "\n")
    x, y, z, u = last_lines(tmp_path, *ROWS)[1:-2]
    assert u.startswith("u: A or B may be dangerous at the fewest speeds (5 to 25 rad/s), B or C may be at the most (5 to 25 ")
    assert x.startswith("x: A and B cannot be ranked (dangerous over 40 to 45 rad/s); ")
    assert y.startswith("y: A or B may be dangerous at the fewest speeds (0 to 5 rad/s), C is at the most (9 rad/s); ")
    assert z.startswith("z: D0, D1, D2, D3 and 8 more cannot be ranked (dangerous over 0 rad/s); ")


def test_the_ranking_over_scenes_on_points(tmp_path):
    """A sum of several ranges is told apart from the widest of them."""
    head = "blade,scene,rank_lowest,rank_highest,contact,rank_over_scenes,length_unknown_rad_s,length_dangerous_rad_s,"
    head += "ranges_dangerous,widest_range_from_rad_s,widest_range_rad_s\n"
    points = "S100,x,1,1,{0},3,0,13.2,1,1200,13.2\nA,x,2,2,{0},1,0,40,1,1200,40\nRef,x,3,3,{0},1,0,128.9,3,1635.2,119.9\n"
    points += "Ref,y,1,1,{0},1,0,47,1,1300,47\nA,y,2,2,{0},1,0,130,2,900,100\nS100,y,3,3,{0},3,0,854.2,4,900,800\n"
    points = points.format('"8 points, linear"')
    (tmp_path / "ranking.csv").write_text(head + points)
    lined, bare, over, contact = last_lines(tmp_path, *ROWS)[1:-2]
    assert lined.startswith("8 points, linear: x: S100 is dangerous") and over.startswith("8 points, linear: over both scenes")
    assert "Ref is at the most (129 rad/s in 3 ranges, the widest from 1635 to 1755); " in lined and "(13 rad/s)" in lined
    assert "S100 is at the most (854 rad/s in 4 ranges" in bare
    assert over.endswith(", by the longest length in any (rad/s): Ref 129 = A 130, S100 854 (=: cannot be told apart)")
    assert contact == ("the ranking is of contact on points; a decision needs structure: { boundary: { contact: patches } }")


def test_runs_that_diverged_are_counted(tmp_path):
    """No interaction is found where none was completed."""
    for status, said in (([0, 0, 2], ""), ([1, 1, 2], "; 2 of 2 runs diverged"), ([0, 1, 0], "; 1 of 3 runs diverged")):
        runs = _runs(status, [[[1.0, np.nan, np.nan]]], ["direct"])
        runs.to_netcdf(tmp_path / "rms.nc")
        first, *remarks = last_lines(tmp_path)
        assert first == f"found no interaction{said}"
        # the cause of a linear blade's, and what bounds it
        assert said == "" or remarks[0].startswith("Ref in direct: runs diverged, as friction can feed a linear motion")
        runs.assign(peak_share_of_height=(("blade", "scene", "speed"), [[[0.1, 0.1, 0.1]]])).to_netcdf(tmp_path / "rms.nc")
        assert not any("friction" in line for line in last_lines(tmp_path))


def _runs(status, force, scenes):
    variables = {"status": (("blade", "scene", "speed"), np.broadcast_to(np.array(status, "i1"), np.shape(force)))}
    variables["largest_normal_force"] = (("blade", "scene", "speed"), force)
    return xr.Dataset(variables, {"blade": ["Ref"], "scene": scenes})


def test_scenes_that_touch_nothing_are_named(tmp_path):
    """A single force is enough to touch; a scene without any run is none that touches nothing."""
    forces = [[[0.0, 0.0, np.nan], [0.0, 2.0, np.nan], [np.nan] * 3]]
    _runs([0, 0, 2], forces, ["far", "near", "none"]).to_netcdf(tmp_path / "rms.nc")
    said = last_lines(tmp_path)
    assert len(said) == 4 and said[1].startswith("Ref in far: the tip touched nothing at any speed, ")


def test_motions_beyond_the_second_order_are_told(tmp_path):
    runs, dims = _runs([0, 0, 0], [[[1.0, 1.0, 1.0]]], ["bare"]), ("blade", "scene", "speed")
    for shares, said in (([np.nan, 0.1, 0.2], 3), ([0.1, 0.3, 0.25], 4)):
        limits = {"peak_share_of_height": (dims, [[shares]]), "share_of_height_limit": (dims, [[[0.2, 0.2, 0.26]]])}
        runs.assign(limits).to_netcdf(tmp_path / "rms.nc")
        lines = last_lines(tmp_path)
        assert len(lines) == said
    assert lines[1].startswith("beyond the model's limits in 1 run: the tip moves by up to 0.3 of the blade's height; ")


def test_linings_are_compared_with_the_tips_of_the_blades():
    names = ("lining_elastic_stiffness", "lining_plastic_stiffness", "tip_stiffness", "lined_tip_share")
    numbers = {"Ref": (5.07e6, 1.014e6, 7.48e6, 0.289), "S100": (5.07e6, 1.014e6, 6.2e6, 0.3)}
    runs = {(blade, "abradable"): dict(zip(names, values, strict=True)) for blade, values in numbers.items()}
    assert lining_texts(runs) == [
        "abradable: stiffness of the lining at the tip 5.07e+06 N/m, 1.01e+06 while it wears, on 28.9 to 30% of the tip's "
        "length; of the blade there 6.2e+06 to 7.48e+06 N/m"
    ]
    assert lining_texts({}) == []


def test_nothing_found_and_nothing_new(tmp_path):
    assert closing_lines(tmp_path, 0.0, 1.0) == []
    assert last_lines(tmp_path)[0] == "found no interaction"
    assert closing_lines(written(tmp_path), 2000.0, 2001.0) == []


def extension(*files, **more):
    return Extension(name="mine", targets=lambda sweep: {f"<results>/{name}": [{}] for name in files}, **more)


@pytest.fixture
def line(settings, tmp_path):
    """What is said of an extension whose targets are all there, made at 1000 s, in a run that began then."""

    def of(extension, began=1000.0):
        for name in extension.targets(None):
            file = tmp_path / name.removeprefix("<results>/")
            file.touch()
            os.utime(file, (1000.0, 1000.0))
        return line_of_extension(extension, Sweep(settings), tmp_path, began).replace(str(tmp_path), "results")

    return of


def test_an_extension_without_a_word_names_what_a_person_opens_first(line, tmp_path):
    assert line(extension("mine.nc", "mine.csv")) == "mine: 2 files made; look at results/mine.csv"
    assert line(extension("mine.nc", "a.pdf", "a.png", "mine.csv")) == "mine: 4 files made; look at results/a.png"
    assert line(extension("mine.csv", "a.png", "mine.html")).endswith("look at results/mine.html")
    assert line(extension("mine.inp")) == "mine: 1 file made; look at results/mine.inp"
    assert line(extension("mine.inp", "mine.csv", look_at="<results>/mine")).endswith("look at results/mine")
    # of what is older, or is not there, nothing is said
    assert line(extension("mine.csv"), began=1001.0) == ""
    os.utime(tmp_path / "mine.csv", (2000.0, 2000.0))
    assert line_of_extension(extension("other.csv"), Sweep(None), tmp_path, 0.0) == ""


def test_an_extension_s_own_word(line, monkeypatch):
    monkeypatch.setitem(sys.modules, "words", SimpleNamespace(closing=lambda results: f"{len(list(results.iterdir()))} rotor"))
    assert line(extension("rotor.png", closing="words.closing")) == "mine: 1 rotor; look at results/rotor.png"


@pytest.mark.parametrize("extension", EXTENSIONS, ids=lambda extension: extension.name)
def test_the_words_of_the_shipped_extensions_are_there(extension):
    if extension.closing:
        assert callable(function_named(extension.closing))
