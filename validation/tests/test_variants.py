"""Tables of rotors, tolerances and lengths of runs, from made-up results."""

import numpy as np
import xarray as xr
from evidence import lasting, rotor, tolerances
from evidence.plan import Named
from evidence.tables import read_table

from r37core.time_integration.settling import MotionAtEnd


def response(file, **changes):
    """A response above yield from 810 to 820 rad/s, written to a file."""
    speeds = np.arange(800.0, 840.0, 10.0)
    stress = np.array([0.5, 2.0, 2.0, 0.5])
    content = {f"max_von_mises_{name}": ("speed", stress) for name in ("ever", "inside", "median", "high")}
    content |= {
        "share_of_revolutions_above_yield": ("speed", (stress > 1.0).astype(float)),
        "status": ("speed", np.zeros(4, "i1")),
        "exit_revolution": ("speed", np.full(4, np.nan)),
        "exit_cause": ("speed", np.zeros(4, "i1")),
        "motion_at_end": ("speed", np.full(4, MotionAtEnd.LASTING, "i1")),
        "yield_stress": 1.0,
        "lined": 1.0,
    }
    for direction in ("normal", "tangential"):
        content[f"rms_{direction}"] = (("speed", "tip_point"), np.ones((4, 2)))
    labels = {"speed": speeds, "tip_point": ["leading_edge", "trailing_edge"]}
    xr.Dataset(content | changes, labels).to_netcdf(file)
    return str(file)


def test_rotors_are_judged_as_a_single_blade_is(tmp_path):
    shares = ("speed", np.array([0.0, 0.8, 0.8, 0.0]))
    whole = response(tmp_path / "rotor.nc", share_of_revolutions_above_yield=shares)
    axes = {"blade": list(rotor.BLADES), "mode": ["1B"], "engine_order": [4]}
    xr.Dataset({"crossing_speed": (tuple(axes), [[[810.0]], [[800.0]]])}, axes).to_netcdf(tmp_path / "campbell.nc")
    at_once = [f"{blade},{kind},{12 if kind == 'equal' else 0}" for blade in rotor.BLADES for kind in ("equal", "mistuned_1")]
    (tmp_path / "rotors.csv").write_text("\n".join(["blade,scene,blades_above_yield", *at_once]))
    files = Named({kind: [whole] * 2 for kind in rotor.KINDS})
    files["single"] = [response(tmp_path / "single.nc")] * 2
    files |= {"campbell": str(tmp_path / "campbell.nc"), "rotors": str(tmp_path / "rotors.csv")}
    output = Named(table=tmp_path / "table.csv", picture=tmp_path / "rotor.png")
    rotor.kinds(files, output, Named())
    _, single, _, equal, *_ = read_table(tmp_path / "table.csv")
    assert single == ["Ref", "a single blade", "23 / 0 / 20", "-0.8, +2.1", "-", "-0.6, +1.9", "2.00", "1"]
    assert equal == ["Ref", "36 equal blades", "23 / 0 / 18", "-0.8, +2.1", "-", "-0.5, +1.7", "2.00", "12"]
    assert output.picture.stat().st_size > 10_000


def test_lengths_of_runs_next_to_each_other(tmp_path):
    files = [response(tmp_path / "short.nc"), response(tmp_path / "long.nc", motion_at_end=("speed", [1, 1, 2, 3]))]
    files.append(files[0])
    output = Named(table=tmp_path / "table.csv", picture=tmp_path / "picture.png")
    lasting.lasting(Named(runs=files), output, Named(revolutions=["200", "1,000", "until settled"]))
    _, short, long, _ = read_table(output.table)
    assert short[2:] == ["4", "0", "0", "0"] and long[2:] == ["1", "1", "2", "0"]
    assert output.picture.stat().st_size > 10_000


def test_a_coefficient_whose_interval_holds_zero_is_a_dash():
    known = xr.Dataset({"rank_coefficient": 0.7, "rank_coefficient_low": 0.57, "rank_coefficient_high": 0.82})
    assert tolerances.coefficient(known) == "0.70 (0.57 to 0.82)"
    assert tolerances.coefficient(known.assign(rank_coefficient_low=-0.1)) == tolerances.UNKNOWN


def test_the_farthest_speed_is_that_of_any_member():
    stresses = [[0.0, 0.0, 0.0, 0.0], [0.0, 2.0, 0.0, 0.0], [0.0, 0.0, 2.0, np.nan]]
    content = {"max_von_mises_inside": stresses, "status": np.zeros((3, 4)), "exit_revolution": np.full((3, 4), np.nan)}
    members = xr.Dataset(
        {name: (("member", "speed"), values) for name, values in content.items()} | {"yield_stress": 1.0},
        {"member": [0, 1, 2], "speed": [800.0, 810.0, 820.0, 830.0]},
    )
    assert tolerances.farthest(members.sel(member=[0, 1]), 800.0) == "+1.9"
    assert tolerances.farthest(members, 800.0) == "+2.5"
    assert tolerances.farthest(members.sel(member=[0]), 800.0) == tolerances.UNKNOWN
