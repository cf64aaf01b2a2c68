"""Evidence of the pages on ranking and the lining, on made-up data."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from evidence import lining, which_blade
from evidence.pages import read_table

RANDOM = np.random.default_rng(0)


def test_scatter_is_that_of_the_noise_and_not_of_the_curve():
    speeds = np.linspace(0.0, 1.0, 4001)
    values = (2.0 + np.sin(6.0 * speeds)) * (1.0 + 0.03 * RANDOM.standard_normal(len(speeds)))
    assert which_blade.scatter(values) == pytest.approx(3.0, rel=0.1)


def response(above, step=1.0, lined=1.0):
    """A response on speeds from 800 rad/s on, whose shares are 1 in the range `above` and 0 elsewhere."""
    speeds = np.arange(800.0, 900.5, step)
    shares = ((speeds >= above[0]) & (speeds <= above[1])).astype(float)
    content = {"share_of_revolutions_above_yield": ("speed", shares), "status": ("speed", np.zeros(len(speeds), "i1"))}
    content |= {"rms_normal": (("speed", "tip_point"), np.ones((len(speeds), 2))), "lined": lined}
    return xr.Dataset(content, {"speed": speeds})


def test_adaptive_speeds_stand_next_to_all(tmp_path):
    """Both scenes in one row; the grid of 20 rad/s misses the lined range."""
    files = {}
    for kind, step in (("every", 1.0), ("adaptive", 20.0)):
        for scene, lined in (("abradable", 1.0), ("direct", 0.0)):
            file = tmp_path / kind / "Ref" / scene / "response.nc"
            file.parent.mkdir(parents=True)
            response((841, 851), step, lined).to_netcdf(file)
            files.setdefault(kind, []).append(str(file))
    which_blade.adaptive(SimpleNamespace(**files), SimpleNamespace(table=tmp_path / "table.csv"), None)
    head, row = read_table(tmp_path / "table.csv")
    assert head[1:3] == ["lining: every 1 rad/s", "lining: adaptive"]
    assert row[:3] == ["Ref", "11 ± 1 (12)", "0 (0)"]


def test_blades_are_ranked_by_contact_length(tmp_path):
    files = []
    for blade, lengths in {"Ref": (30.0, 5.0), "S100": (10.0, 20.0)}.items():
        files.append(tmp_path / f"{blade}.csv")
        pd.DataFrame([{"blade": blade, "0.05": lengths[0], "1": lengths[1]}]).to_csv(files[-1], index=False)
    output = SimpleNamespace(table=tmp_path / "table.csv", picture=tmp_path / "picture.png")
    lining.contact_lengths(SimpleNamespace(files=files), output, None)
    head, *rows = read_table(output.table)
    assert head == ["blade", "0.05 mm", "1 mm"]
    assert rows == [["Ref", "30 (2)", "5 (1)"], ["S100", "10 (1)", "20 (2)"]]
    assert output.picture.stat().st_size > 10_000


def test_steep_speeds_are_at_the_top_of_the_widest_range():
    found = response((841, 851))
    found["rms_normal"] = found["rms_normal"] + (found["speed"] == 848.0)
    found["rms_tangential"] = found["rms_normal"]
    assert which_blade.steep_speeds(found.assign_coords(tip_point=["leading_edge", "trailing_edge"]))[6:] == [848.0, 850.0]
    assert len(which_blade.steep_speeds(response((0, 1)))) == 6
