"""Requirements: each judged on numbers that are known, its margin, place and certainty, and the tables of a run."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from box_mesh import box_mesh
from integration_cases import DIRECT

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.plain import to_plain
from r37core.config import ConfigError, command_line_document, operating_range
from r37core.fem.assembly import mesh_volume
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.results.datasets import FURTHER_RUNS, response_of, with_further_runs
from r37core.results.operating_range import OperatingDwell, OperatingRange
from r37core.results.regions import judged as judged_region
from r37core.results.steps import ranking
from r37core.results.table_file import read_table, write_table
from r37core.results.variables import VARIABLES
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus
from r37studies.other_models import ModelChoice
from r37studies.requirements import steps
from r37studies.requirements.choice import CampbellMargin, Requirements, run_up_lengths
from r37studies.requirements.evidence import Evidence, extended, worst_of
from r37studies.requirements.judging import (
    AT_LEAST,
    COARSER_MESH,
    DOWN,
    FAILS,
    HALF_STEP,
    HIGHEST_DAMPING,
    LESS_FRICTION,
    MEETS,
    NOT_APPLICABLE,
    REST,
    UNKNOWN,
    UP,
    closeness,
    fails_clearly,
    judge,
    nearness,
)
from r37studies.requirements.looks import joined_looks
from r37studies.requirements.plan import Judged, remarks
from r37studies.requirements.table import closing, overall, reason, verdict_table

SPEEDS = np.arange(1000.0, 1301.0, 5.0)
FLOWN = OperatingRange(1050.0, 1250.0)


def above(first, last):
    """Shares of a motion that repeats itself, above yield at speeds from the first to the last."""
    return ((first <= SPEEDS) & (last >= SPEEDS)).astype(float)


def at(speed, value, elsewhere):
    return np.where(speed == SPEEDS, value, elsewhere)


def everywhere(value):
    return np.full(len(SPEEDS), value)


def response(shares=None, **more):
    """Of runs that are nowhere above yield, unless said: twice of it where the share is 1; arrays are over the speeds."""
    content = {"max_von_mises_inside": everywhere(0.0) if shares is None else 2.0 * shares, "yield_stress": 1.0}
    content |= {"status": everywhere(0), "exit_revolution": everywhere(np.nan), "lined": 1.0, "static_stress": 1.0} | more
    of_speed = {name: ("speed", values) if isinstance(values, np.ndarray) else values for name, values in content.items()}
    return xr.Dataset(of_speed, {"speed": SPEEDS})


def stressed(stress):
    """A response with its largest stress, as shares of yield."""
    return response(max_von_mises_inside=2.0 * stress, yield_stress=2.0)


def left_at(runs, *speeds):
    """The response with runs that leave the model in their third revolution, by a force, at these speeds."""
    left = np.isin(SPEEDS, speeds)
    limits = {"largest_normal_force": np.where(left, 9000.0, 90.0), "peak_share_of_height": np.where(left, 0.01, 0.01)}
    limits["exit_revolution"] = np.where(left, 3.0, np.nan)
    return runs.assign({name: ("speed", values) for name, values in limits.items()})


def fatigued(share):
    return response(goodman_share_inside=share, fatigue_strength=6e8)


def growing_at(runs, *speeds):
    """The response with motions that still grow at these speeds, as the runs end."""
    return runs.assign(motion_at_end=("speed", np.where(np.isin(SPEEDS, speeds), MotionAtEnd.GROWING, MotionAtEnd.QUIET)))


def followed(runs):
    return runs.assign(followed=("speed", everywhere(1.0)))


def untouched(runs):
    return runs.assign(share_of_time_in_contact=0.0 * runs["status"])


def diverged_at(runs, *speeds):
    return runs.assign(status=("speed", np.where(np.isin(SPEEDS, speeds), RunStatus.DIVERGED, RunStatus.COMPLETED)))


def campbell(crossing=1200.0):
    """Frequencies that are the same at every speed: 1B crosses order 4, and 1T minus 1B order 6 at 1300 rad/s."""
    hertz = np.cumsum([4.0 * crossing, 6.0 * 1300.0])[:, None] / (2.0 * np.pi) + np.zeros(9)
    frequency = xr.DataArray(hertz, {"mode": ["1B", "1T"], "speed": np.linspace(0.0, 2000.0, 9)})
    crossings = xr.DataArray([[crossing, np.nan]], {"mode": ["1B"], "engine_order": [4, 5]}, ("mode", "engine_order"))
    return xr.Dataset({"crossing_speed": crossings.reindex(mode=["1B", "1T"]), "frequency": frequency})


def one(needs, runs=None, **evidence):
    known = {"campbell": campbell(), "operating": FLOWN, "clearance": 3e-4} | evidence
    (row,) = judge(needs, Evidence(QUIET if runs is None else runs, **known))
    return row


def over_members(name, shares, **more):
    """Members that have these numbers at every speed, shape (members, speeds)."""
    content = {name: (("member", "speed"), shares), "status": (("member", "speed"), np.zeros(shares.shape, int))}
    content["exit_revolution"] = (("member", "speed"), np.full(shares.shape, np.nan))
    return xr.Dataset(content | more, {"speed": SPEEDS, "member": np.arange(len(shares))})


SCARCE = response().isel(speed=slice(None, None, 2))
ABOVE = Requirements(above_yield=0.0)
GOODMAN = Requirements(goodman_share=1.0)
LINING = Requirements(used_lining=0.7)
QUIET, LOUD = response(), response(above(1100.0, 1120.0))
TWO = response(above(1020.0, 1080.0) + above(1200.0, 1230.0))
WORN = response(
    used_thickness=np.maximum(6e-4 - 1e-5 * np.abs(SPEEDS - 1200.0), at(1000.0, 9e-4, 2e-4)), worn_through_share=everywhere(0.0)
)
SLIGHT = response(used_thickness=everywhere(6e-5))
TIRED = fatigued(at(1120.0, 0.7, at(1020.0, 3.0, 0.2)))
SHARP, BROAD = fatigued(at(1150.0, 0.5, 0.2)), fatigued(0.5 - 1e-5 * (SPEEDS - 1150.0) ** 2)
CLOSE = stressed(at(1150.0, 0.98, 0.5))
PAST = stressed(at(1150.0, 1.08, 0.6))
NEARLY = stressed(at(1150.0, 0.9, 0.45))
GROWN = stressed(at(1150.0, 1.5, at(1100.0, 0.6, 0.4)))
LACKING = response(at(1150.0, np.nan, 0.0), fatigue_strength=6e8).assign(
    {name: ("speed", at(1150.0, np.nan, 0.0)) for name in ("used_thickness", "goodman_share_inside")}
)
ROOM = np.tile(5e-4 - 1e-6 * (SPEEDS - 1000.0), (2, 1)).T
CROSSING = Requirements(campbell_margins=(CampbellMargin("1B", (4,), 0.05),))
MOTIONS = LOUD.sel(speed=slice(1090.0, 1130.0)).assign(used_thickness=("speed", np.full(9, np.nan)))
MEMBERS = over_members(
    "max_von_mises_inside",
    2.0 * np.stack([everywhere(0.0), above(1100.0, 1120.0), everywhere(0.0), above(1290.0, 1300.0)]),
    lined=1.0,
    yield_stress=1.0,
)
TIRED_MEMBERS = over_members(
    "goodman_share_inside", np.stack([everywhere(0.5), everywhere(0.9)]), fatigue_strength=("member", [3e8, 3e8])
)
THICK = {"thickness": 1e-3}


def peak(top):
    return fatigued(at(1150.0, top, np.maximum(0.8 - 0.01 * np.abs(SPEEDS - 1150.0), 0.2)))


def on_mesh_and_step(coarse, fine):
    """Looks at the peak on a mesh of half the nodes and with half the step, where the level's error is not known."""
    near = slice(1145.0, 1155.0)
    return {"looks": {REST: PEAK, COARSER_MESH: coarse.sel(speed=near), HALF_STEP: fine.sel(speed=near)}, "error": np.nan}


PEAK = peak(0.8)


TOLD = dict(row.split(" => ") for row in Path(__file__).with_name("verdicts.txt").read_text().splitlines())
"""What is told of each case: its verdict, all numbers that are known, and the note, whole."""


def case(shows, needs=ABOVE, runs=QUIET, **evidence):
    return pytest.param(needs, runs, evidence, TOLD.pop(shows), id=shows)


CASES = [
    # above yield from 1017.5 to 1082.5 and 1197.5 to 1232.5, half of the way between speeds: 32.5 and 35 inside; three borders
    # inside, each anywhere between two speeds, are a scatter of 2.5
    case("lengths inside the range count", Requirements(above_yield=62.4), TWO),
    case("by two of its scatter a length keeps no limit", Requirements(above_yield=72.4), TWO),
    case("by two of its scatter a length may keep a limit", Requirements(above_yield=62.6), TWO),
    case("what lies outside does not count", ABOVE, response(above(1270.0, 1290.0))),
    case("below yield inside the model", ABOVE, response(at(1050.0, 0.42, 0.0))),
    case("what leaves the model first is not known", ABOVE, left_at(QUIET, 1100.0, 1105.0)),
    case("yield before the exit is danger", ABOVE, left_at(LOUD, *SPEEDS)),
    case("danger at some speeds, an exit at others", ABOVE, left_at(LOUD, 1150.0)),
    case("an exit by a limit that no number tells", ABOVE, response(exit_revolution=at(1100.0, 3.0, np.nan))),
    case("an exit outside of operation", ABOVE, left_at(QUIET, 1020.0)),
    case("the model is left below the Goodman line", GOODMAN, left_at(TIRED.assign(yield_stress=1.0), 1120.0)),
    case("a length across the end", ABOVE, response(above(1020.0, 1080.0))),
    case(
        "a run that diverged is above yield",
        ABOVE,
        diverged_at(response(at(1100.0, np.nan, 0.0), diverged_revolution=at(1100.0, 3.7, np.nan)), 1100.0),
    ),
    case("speeds are not run", ABOVE, response().isel(speed=slice(16, None))),
    case("stress is not computed", ABOVE, QUIET.drop_vars("max_von_mises_inside")),
    case("wear is not computed", LINING, **THICK),
    case("fatigue is not computed", GOODMAN),
    # 0.9 mm at 1000 rad/s is outside
    case("used lining", LINING, WORN, **THICK),
    case("wear that grows", LINING, growing_at(WORN, 1200.0), **THICK),
    case("wear that grows far below the limit", LINING, growing_at(SLIGHT, 1200.0), **THICK),
    # at half of the limit, and so much below it
    case("wear that grew far below the limit as it was followed", LINING, followed(growing_at(SLIGHT, 1200.0)), **THICK),
    case("wear that grew to half of the limit", Requirements(used_lining=0.12), followed(growing_at(SLIGHT, 1200.0)), **THICK),
    case(
        "worn through", Requirements(used_lining=1.0), WORN.assign(worn_through_share=("speed", at(1150.0, 0.1, 0.0))), **THICK
    ),
    case("no lining", LINING, WORN),
    case("every run diverged", LINING, diverged_at(WORN, *SPEEDS), **THICK),
    case("nothing used", LINING, response(used_thickness=everywhere(0.0)), **THICK),
    # 3 at 1020 rad/s is outside
    case("share of the Goodman line", Requirements(goodman_share=0.5), TIRED),
    case("it diverged", Requirements(goodman_share=5.0), diverged_at(TIRED, 1150.0)),
    case("no strengths", GOODMAN, TIRED.assign(fatigue_strength=np.inf)),
    # no run lies inside
    case(
        "a range between two runs has the larger of both",
        GOODMAN,
        fatigued(at(1045.0, 2.0, 0.2)),
        operating=OperatingRange(1047.5, 1049.0),
    ),
    case(
        "up to the next run nothing is known beside one that diverged",
        GOODMAN,
        diverged_at(fatigued(everywhere(0.2)), 1045.0),
        operating=OperatingRange(1049.9, 1060.0),
    ),
    case("speeds far apart", ABOVE, SCARCE),
    case("speeds far apart where nothing touches", ABOVE, untouched(SCARCE)),
    case("speeds far apart that fail", ABOVE, LOUD.isel(speed=slice(None, None, 2))),
    case("another motion fails", looks={REST: QUIET, UP: LOUD}),
    case("further runs stand in place of the sweep's", ABOVE, LOUD, looks={REST: QUIET}),
    case("one run with another friction, over those from rest", looks={REST: QUIET, LESS_FRICTION: LOUD.sel(speed=[1110.0])}),
    case("a quieter motion takes nothing from one that fails", looks={REST: LOUD, UP: QUIET}),
    case(
        "the same motion with another friction does",
        looks={REST: response(above(1110.0, 1110.0)), LESS_FRICTION: QUIET.sel(speed=[1110.0])},
    ),
    case(
        "another damping keeps what fails clearly", ABOVE, LOUD, looks={HIGHEST_DAMPING: QUIET.sel(speed=slice(1100.0, 1120.0))}
    ),
    case(
        "another damping fails at some speeds, too",
        ABOVE,
        LOUD,
        looks={HIGHEST_DAMPING: QUIET.sel(speed=slice(1100.0, 1110.0))},
    ),
    case("nothing was looked at", not_looked="no further runs of a rotor"),
    # 0.98 of yield at one speed: with 5% more it is above, and the length that of one speed
    case("a large error of mesh and step", ABOVE, CLOSE, error=0.05),
    case("above yield with a large error", ABOVE, PAST, error=0.1),
    case(
        "all that was tried has the error",
        Requirements(used_lining=0.9),
        error=0.05,
        looks={
            REST: response(used_thickness=everywhere(4e-4)),
            LESS_FRICTION: response(used_thickness=everywhere(8.9e-4)).sel(speed=[1150.0]),
        },
        **THICK,
    ),
    case("an error of the mesh", GOODMAN, PEAK, **on_mesh_and_step(peak(0.84), peak(0.8))),
    case("an error of the step", GOODMAN, PEAK, **on_mesh_and_step(peak(0.8), peak(0.76))),
    case("large errors of mesh and step", GOODMAN, PEAK, **on_mesh_and_step(peak(0.99), peak(0.7))),
    case(
        "the error is that of speeds that ended both ways",
        GOODMAN,
        PEAK,
        **on_mesh_and_step(diverged_at(peak(0.84), 1145.0), PEAK),
    ),
    case(
        "equal largest values at other speeds",
        GOODMAN,
        looks={
            REST: fatigued(at(1150.0, 0.97, 0.7)),
            COARSER_MESH: fatigued(at(1100.0, 0.97, 0.7)),
            HALF_STEP: fatigued(at(1100.0, 0.97, 0.7)),
        },
        error=0.01,
    ),
    case("an error below that of the level", GOODMAN, PEAK, **on_mesh_and_step(PEAK, PEAK) | {"error": 0.1}),
    case("where none did it is that of the level", GOODMAN, PEAK, **on_mesh_and_step(diverged_at(PEAK, *SPEEDS), PEAK)),
    case("a length ends with the range", Requirements(above_yield=300.0), response(above(1055.0, 1300.0))),
    case("a peak between speeds", GOODMAN, looks={REST: fatigued(at(1150.0, 0.9, 0.2))}),
    case(
        "a drift up to the limit",
        GOODMAN,
        looks={REST: fatigued(everywhere(0.8)).assign(stress_drift=("speed", at(1150.0, 0.25, 0.0)))},
    ),
    case("a peak at the limit", GOODMAN, looks={REST: fatigued(at(1150.0, 1.0, 0.95))}),
    case(
        "where nothing is stressed nothing differs",
        GOODMAN,
        looks=dict.fromkeys((HALF_STEP, COARSER_MESH), fatigued(everywhere(0.0)).sel(speed=[1100.0]))
        | {REST: fatigued(at(1150.0, 0.75, 0.0))},
        error=np.nan,
    ),
    case("an error that was not measured", GOODMAN, PEAK, error=np.nan),
    case("what fails clearly has no need of it", Requirements(goodman_share=0.6), PEAK, error=np.nan),
    case("what fails less clearly has", Requirements(goodman_share=0.75), PEAK, error=np.nan),
    case("a sharp peak may be higher", GOODMAN, SHARP, error=0.03),
    case("a broad one is known", GOODMAN, BROAD),
    case("a drift", GOODMAN, BROAD.assign(stress_drift=("speed", at(1150.0, 0.05, 0.0)))),
    case("a large drift", GOODMAN, BROAD.assign(stress_drift=("speed", at(1150.0, 1.2, 0.0)))),
    case(
        "another requirement fails, and this one is far below",
        GOODMAN,
        fatigued(everywhere(0.3)),
        not_looked="few further runs",
        fails_elsewhere=True,
    ),
    case(
        "another requirement fails, and this one is near",
        GOODMAN,
        fatigued(everywhere(0.4)),
        not_looked="few further runs",
        fails_elsewhere=True,
    ),
    case("a motion grows near the limit", ABOVE, growing_at(NEARLY, 1100.0, 1150.0)),
    case("a motion grows far from it", ABOVE, growing_at(NEARLY, 1100.0)),
    case("growth comes to the limit", Requirements(above_yield=20.0), growing_at(GROWN, 1100.0)),
    case("growth above yield counts already", Requirements(above_yield=20.0), growing_at(GROWN, 1150.0)),
    case(
        "growth of a motion that is carried up",
        Requirements(above_yield=20.0),
        GROWN,
        looks={REST: GROWN, UP: growing_at(GROWN, 1100.0)},
    ),
    case(
        "the worst of several motions",
        Requirements(goodman_share=0.5),
        looks={look: fatigued(everywhere(share)) for look, share in ((REST, 0.2), (UP, 0.6), (DOWN, 0.7))},
    ),
    case("stress of vibration alone", ABOVE, response(static_stress=0.0)),
    case("stress of vibration alone fails", ABOVE, LOUD.assign(static_stress=0.0)),
    case("contact on points", point_contact=True),
    case("no contact", ABOVE, untouched(QUIET), point_contact=True, not_looked="no further runs of a rotor"),
    case("a stress is lacking", ABOVE, LACKING),
    case("a share of the Goodman line is lacking", GOODMAN, LACKING),
    # next to scenes with a lining a bare casing's motions have its numbers, too
    case(
        "motions over a part of the range",
        motions=MOTIONS.expand_dims(motion=["rest", "up"]).assign(differ=1.0 + 0.0 * MOTIONS["status"]),
    ),
    case("clearance", Requirements(clearance=3e-4), clearance=2e-4),
    # next to a scene that grows
    case(
        "clearance of a scene that grows", Requirements(clearance=2.4e-4), response(clearance=(("speed", "contact_node"), ROOM))
    ),
    case(
        "clearance next to a scene that grows",
        Requirements(clearance=3e-4),
        response(clearance=(("speed", "contact_node"), np.nan * ROOM)),
        clearance=4e-4,
    ),
    case("mass", Requirements(mass=0.1), mass=0.101),
    case("mass that is not known", Requirements(mass=0.1)),
    case("small damage", Requirements(miner_sum=1e-4), miner_sum=5e-5),
    case("damage at once", Requirements(miner_sum=1e-4), miner_sum=np.inf),
    case("damage that is not known", Requirements(miner_sum=1e-4)),
    case("a crossing inside", CROSSING),
    case("a crossing beside the range", CROSSING, campbell=campbell(1300.0)),
    # with dwells the rest of the range is passed, and does not count
    case(
        "a crossing beside a dwell",
        CROSSING,
        operating=OperatingRange(1050.0, 1250.0, dwell=(OperatingDwell(1100.0, 1110.0, 0.5),)),
    ),
    case("no crossing", Requirements(campbell_margins=(CampbellMargin("1B", (2,), 0.05),))),
    case("a crossing of a combination", Requirements(campbell_margins=(CampbellMargin("1T-1B", (6,), 0.05),))),
    case(
        "members and motions",
        members=MEMBERS,
        motions=MEMBERS.rename(member="motion").assign(differ=("speed", everywhere(1.0))),
    ),
    case("members keep fatigue", Requirements(goodman_share=0.8), TIRED_MEMBERS.isel(member=0), members=TIRED_MEMBERS),
]
assert not TOLD

NUMBERS = ("value", "value_lowest", "value_highest", "from_rad_s", "to_rad_s", "scatter")
NUMBERS += ("margin_worst_motion", "members", "share_of_members")


@pytest.mark.parametrize(("needs", "runs", "evidence", "told"), CASES)
def test_verdict(needs, runs, evidence, told):
    row = one(needs, runs, **evidence)
    known = [
        f"{name.removeprefix('value_').removesuffix('_rad_s')} {row[name]:.5g}" for name in NUMBERS if row[name] == row[name]
    ]
    assert " | ".join(filter(None, [row["verdict"], ", ".join(known), row["note"]])) == told
    below = row["limit"] - row["value"]
    assert np.nan_to_num(row["further_runs"]) == sum(runs.sizes["speed"] for runs in evidence.get("looks", {}).values())
    assert row["margin"] == pytest.approx(-below if needs.clearance or needs.campbell_margins else below, nan_ok=True)


def test_runs_and_motions_over_parts_of_the_speeds_are_joined():
    """Datasets of a run have their speeds in revolutions per minute, too; those of sweeps do not."""
    runs = response(above(1000.0, 1300.0)).assign_coords(speed_rpm=("speed", 9.55 * SPEEDS))
    joined = extended(runs, response().isel(speed=slice(2, -2)))
    assert joined["speed"].values.tolist() == SPEEDS.tolist() and list(joined.coords) == ["speed"]
    assert joined["max_von_mises_inside"].sum() == 8.0


@pytest.mark.parametrize(
    ("needs", "nearest"),
    [
        (ABOVE, 1.5),
        (Requirements(goodman_share=0.5), 0.8),
        (Requirements(used_lining=0.25, goodman_share=0.8), 0.8),
        (Requirements(used_lining=0.25), 0.8),
    ],
)
def test_how_near_runs_come_to_a_limit(needs, nearest):
    shares = {"goodman_share_inside": ("speed", everywhere(0.4)), "used_thickness": ("speed", everywhere(1e-3))}
    runs = diverged_at(stressed(at(1100.0, 1.5, 0.5)).assign(shares), 1000.0)
    near = nearness(needs, Evidence(runs, operating=FLOWN, thickness=5e-3))
    assert (near[0], near[1:].max()) == (np.inf, pytest.approx(nearest))
    close = closeness(needs, Evidence(runs, operating=FLOWN, thickness=5e-3))
    assert close[0] == 0.0
    np.testing.assert_allclose(close[1:], np.minimum(near, 1.0 / near)[1:])


def test_a_tip_may_touch_where_no_run_says_that_it_does_not():
    quiet = untouched(response())
    few = quiet.isel(speed=[0, -1])
    assert Evidence(few, operating=FLOWN, clearance=3e-4).touches is False
    # a run beside the range counts where the range begins or ends between two
    beside = few.assign(share_of_time_in_contact=("speed", np.array([0.3, 0.0])))
    for runs in (beside, quiet.isel(speed=slice(20, None)), diverged_at(quiet, 1100.0)):
        assert Evidence(runs, operating=FLOWN, clearance=3e-4).touches
    # a clearance that changes with the speed may close between two
    assert Evidence(quiet, operating=FLOWN).touches


def test_a_run_outside_of_the_range_fails_nothing_clearly():
    runs = stressed(np.where(SPEEDS <= 1045.0, 3.0, 0.5))
    assert fails_clearly(ABOVE, Evidence(runs, operating=OperatingRange(1046.0, 1060.0))) == []
    assert fails_clearly(ABOVE, Evidence(runs, operating=OperatingRange(1045.0, 1060.0))) == ["above_yield"]


def test_the_worst_of_motions_diverged_where_one_did():
    status = [[RunStatus.DIVERGED, RunStatus.NOT_RUN], [RunStatus.NOT_RUN, RunStatus.COMPLETED]]
    motions = xr.Dataset({"status": (("motion", "speed"), np.array(status, int))}, {"speed": [1.0, 2.0]})
    assert worst_of(motions)["status"].values.tolist() == [RunStatus.DIVERGED, RunStatus.COMPLETED]


@pytest.fixture
def judged():
    of = {"above": above(1100.0, 1120.0), "below": None}
    stress = xr.concat([response(shares) for shares in of.values()], "scene").assign_coords(scene=list(of))
    datasets = {"rms": stress[["status", "lined"]].expand_dims(blade=["Ref"]), "stress": stress.expand_dims(blade=["Ref"])}
    datasets["campbell"] = campbell().expand_dims(blade=["Ref"])
    pairs = [("Ref", "above"), ("Ref", "below")]
    needs = Requirements(above_yield=0.0, mass=0.1)
    return verdict_table({pair: {"mass": 0.05} for pair in pairs}, needs, FLOWN, datasets), datasets, pairs


def test_the_verdict_of_a_run(judged, tmp_path):
    verdict, _, _ = judged
    assert verdict["requirement"].tolist() == ["above_yield", "mass"] * 2
    assert overall(verdict)["verdict"].tolist() == ["fails", "meets"]
    write_table(verdict, tmp_path / "verdict.csv")
    lines = closing(tmp_path).splitlines()
    assert lines[1].strip() == (
        "Ref in above fails: above_yield by 25 rad/s, 1097.5 to 1122.5 rad/s "
        f"({AT_LEAST}; over 25 of 200 rad/s, 20.9 to at least 29.1 rad/s in all that was tried, scatter 2 rad/s)"
    )
    assert lines[2].strip() == "Ref in below meets"


ROW = {"scene": "s", "requirement": "mass", "verdict": MEETS, "value": 100.0, "value_lowest": 100.0, "value_highest": 100.0}
ROW |= {"margin": -100.0, "unit": "rad/s", "note": "", "scatter": 0.0, "members": np.nan, "share_of_members": np.nan}


@pytest.mark.parametrize(
    ("rows", "lines"),
    [
        (
            [{"scatter": 1.0}, {"scatter": 2.0}],
            "verdict\n  B0 in s meets: mass (scatter 1 rad/s)\n  B1 in s meets: mass (scatter 2 rad/s)",
        ),
        (
            [{}] * 7 + [{"verdict": UNKNOWN}] * 2,
            "7 of 9 pairs of blade and scene meet all requirements: "
            "B0 in s, B1 in s, B2 in s, B3 in s, B4 in s, B5 in s, B6 in s; of 2 one cannot tell",
        ),
        (
            [{}] * 10,
            "10 of 10 pairs of blade and scene meet all requirements: "
            "B0 in s, B1 in s, B2 in s, B3 in s, B4 in s, B5 in s, B6 in s, B7 in s and 2 more",
        ),
        ([{"verdict": NOT_APPLICABLE}] * 9, "0 of 9 pairs of blade and scene meet all requirements"),
    ],
)
def test_last_lines(rows, lines, tmp_path):
    table = pd.DataFrame([ROW | {"blade": f"B{number}"} | row for number, row in enumerate(rows)])
    write_table(table, tmp_path / "verdict.csv")
    assert closing(tmp_path) == lines


@pytest.mark.parametrize(
    ("row", "why"),
    [
        ({"from_rad_s": 1000.0, "to_rad_s": 1050.0}, "mass by 100 rad/s, the widest range 1000 to 1050 rad/s"),
        ({"from_rad_s": 1000.0, "to_rad_s": 1099.0}, "mass by 100 rad/s, 1000 to 1099 rad/s"),
        ({"from_rad_s": 1000.0, "to_rad_s": 1000.0, "unit": "1"}, "mass by 100, at 1000 rad/s"),
        (
            {"margin": -np.inf, "note": "every run diverged", "from_rad_s": np.nan, "to_rad_s": np.nan},
            "mass every run diverged",
        ),
        (
            one(Requirements(goodman_share=0.1), TIRED, members=TIRED_MEMBERS, error=0.03),
            f"goodman_share by 0.6, at 1120 rad/s ({AT_LEAST}; over 200 of 200 rad/s, "
            "0.68 to at least 0.721 in all that was tried, 0 of 2 members meet)",
        ),
    ],
)
def test_why_a_requirement_fails(row, why):
    """A range that is clearly shorter than the length is the widest of several."""
    assert reason(pd.Series(ROW | {"verdict": FAILS} | row)) == why


@pytest.mark.parametrize(("first", "last", "gap"), [(1050.0, 1100.0, 195.0), (1050.0, 1055.0, 5.0), (1049.95, 1055.0, 50.0)])
def test_only_gaps_that_reach_into_the_operating_range_count(first, last, gap):
    runs = response().sel(speed=[1000.0, 1050.0, 1055.0, 1250.0, 1300.0])
    assert Evidence(runs, campbell=campbell(), operating=OperatingRange(first, last)).gap == gap


def test_the_volume_of_a_mesh():
    """A box whose inner nodes are moved: elements of any shape fill it."""
    mesh = box_mesh(0.4, 0.2, 0.3, (2, 2, 2), warp=0.1, element="wedge15")
    assert mesh_volume(mesh.blocks, mesh.points) == pytest.approx(0.4 * 0.2 * 0.3, rel=1e-12)


def joined(runs, scenes):
    """Runs of Ref in some scenes, alike, over the axes of a joined dataset."""
    return xr.concat([runs] * len(scenes), "scene").assign_coords(scene=scenes).expand_dims(blade=["Ref"])


def moved(shares, **more):
    """A response of runs that move and have a stress by their shares of revolutions above yield."""
    stresses = {f"max_von_mises{name}": 2.0 * shares for name in ("_ever", "_median", "_high", "_inside")}
    stresses["share_of_revolutions_above_yield"] = shares
    runs = response().assign({name: ("speed", values) for name, values in stresses.items()}).assign(more)
    rms = 1e-3 + 1e-2 * runs["share_of_revolutions_above_yield"].expand_dims(tip_point=["leading_edge"], axis=1)
    runs["status"] = runs["status"].astype("i1").assign_attrs(VARIABLES["status"].attributes)
    return runs.assign(rms_normal=rms, rms_tangential=rms)


@pytest.mark.parametrize("lined", [0.0, 1.0])
def test_tables_and_datasets_have_the_further_runs_that_the_verdict_has(lined, tmp_path):
    """On a bare casing, too, where shares are smoothed, with those of speeds outside of operation."""
    sweep = moved(np.where(SPEEDS <= 1050.0, 0.9, 0.0), lined=lined).sel(speed=SPEEDS[::5])
    further = moved(above(1100.0, 1110.0) + 0.45 * above(1050.0, 1060.0), lined=lined).sel(speed=slice(1050.0, 1250.0))
    scenes = ["looked", "failed", "other"]
    write_dataset(joined_looks({REST: further, UP: sweep}), tmp_path / "looked.nc")
    write_dataset(joined_looks({}), tmp_path / "failed.nc")
    shares = ["share_of_revolutions_above_yield", *(name for name in sweep if str(name).startswith("max_"))]
    stress = sweep[["status", "lined", "yield_stress", *shares]]
    stress = stress.assign({name: stress[name].expand_dims(region=["airfoil", "root"], axis=1) for name in shares})
    rms = sweep[["status", "lined", "rms_normal", "rms_tangential", "exit_revolution"]]
    plain = {"rms": joined(rms, scenes), "stress": joined(stress, scenes)}
    with_campbell = plain | {"campbell": campbell().expand_dims(blade=["Ref"])}
    for name, dataset in with_campbell.items():
        write_dataset(dataset, tmp_path / f"{name}.nc")
    files = {name: tmp_path / f"{name}.nc" for name in [*with_campbell, FURTHER_RUNS]}
    pairs, looked = [["Ref", name] for name in scenes], [["Ref", name] for name in scenes[:2]]
    params = {"pairs": pairs, "known": [{}] * 3, "looked": looked, "densities": {}, "operating": to_plain(FLOWN)}
    params["requirements"] = to_plain(Requirements(above_yield=0.0))
    inputs = {name: files[name] for name in with_campbell} | {
        "volumes": [],
        "looks": [tmp_path / f"{_}.nc" for _ in scenes[:2]],
    }
    output = SimpleNamespace(verdict=tmp_path / "verdict.csv", runs=files[FURTHER_RUNS])
    steps.judge(inputs, output, SimpleNamespace(**params))
    datasets = plain | {FURTHER_RUNS: read_dataset(files[FURTHER_RUNS])}
    judgement = read_table(tmp_path / "verdict.csv").iloc[0]
    assert judgement["value"] == one(Requirements(above_yield=0.0), sweep, looks={REST: further})["value"] > 0.0

    for name in ("failed", "other"):
        xr.testing.assert_identical(response_of(datasets, "Ref", name), response_of(plain, "Ref", name))
    response = response_of(datasets, "Ref", "looked")
    assert response["speed"].values.tolist() == [*SPEEDS[:10:5], *SPEEDS[10:51], *SPEEDS[55::5]]
    xr.testing.assert_equal(response["rms_normal"].sel(speed=further["speed"]), further["rms_normal"])
    del files["campbell"]
    params = {"runs": pairs, "errors": [0.0] * 3, "contacts": {}, "added": {}, "operating": to_plain(FLOWN)}
    ranking(files, SimpleNamespace(table=tmp_path / "ranking.csv"), SimpleNamespace(**params))
    lengths = read_table(tmp_path / "ranking.csv").set_index("scene")["length_dangerous_operating_rad_s"]
    assert lengths["looked"] == judgement["value"] and lengths["other"] != lengths["looked"]
    # the datasets of other pictures, each blade and scene as its response
    whole = with_further_runs("stress", judged_region(plain["stress"]), datasets[FURTHER_RUNS]).sel(blade="Ref", scene="looked")
    ran = whole.isel(speed=np.flatnonzero(whole["status"].values != RunStatus.NOT_RUN))
    for name in ("max_von_mises_ever", "share_of_revolutions_above_yield"):
        np.testing.assert_array_equal(ran[name], response[name])


@pytest.fixture
def with_requirements(config_copy):
    def read(**changes):
        return read_settings(config_copy, command_line_document({"blades": ["Ref"], "scenes": ["direct"]} | changes))

    return read


RANGE = {"idle_rad_s": 1100.0, "redline_rad_s": 1300.0}


YIELD = {"above_yield_at_most_rad_s": 0.0}


@pytest.mark.parametrize(
    ("changes", "lines"),
    [
        ({}, []),
        ({"requirements": {"mass_at_most_kg": 1.0}}, []),
        (
            {"speeds": [1150.0]},
            ["operating: the speeds of Ref in direct do not reach over 1100 to 1300 rad/s; what is judged there is not known"],
        ),
        (
            {
                "requirements": {"goodman_share_at_most": 1.0, "used_lining_at_most_percent": 50.0},
                "scenes": ["abradable", "direct"],
            },
            [
                "requirements: goodman_share cannot be told without fatigue among the results of abradable, direct",
                "requirements: goodman_share cannot be told of Ref without material.fatigue_strength_pa "
                "and ultimate_strength_pa",
            ],
        ),
        (
            {"requirements": {"miner_sum_at_most": 1.0}},
            ["requirements: miner_sum cannot be told of Ref without material.fatigue_exponent"],
        ),
    ],
)
def test_remarks(with_requirements, changes, lines):
    assert remarks(with_requirements(operating=RANGE, **changes)) == lines


def test_the_ends_of_the_range_are_run_once(with_requirements):
    """Those beyond the sweep are not; 1122 rad/s is 1.02 times 1100 but for rounding."""
    for operating, added in (({}, []), ({"margin_percent": 2.0}, [1078.0, 1326.0]), ({"redline_rad_s": 1333.0}, [1333.0])):
        plan = with_requirements(speeds=[{"start": 1080, "stop": 1340, "step": 20}], operating=RANGE | operating)
        (speeds,) = plan.speed_plans.values()
        assert [speed for speed in speeds.certain if speed % 20.0] == [speed for speed in added if speed > 1080.0]
    rounded = with_requirements(
        speeds=[1000.0, 1122.0, 1200.0], operating={"idle_rad_s": 1050.0, "redline_rad_s": 1100.0, "margin_percent": 2.0}
    )
    assert next(iter(rounded.speed_plans.values())).certain == (1000.0, 1029.0, 1050.0, 1100.0, 1122.0, 1200.0)


def test_rates_of_run_ups(with_requirements):
    """Omega^2 = Omega_0^2 + 2 a theta; one that takes thousands of revolutions more than others is refused."""
    squares = 1300.0**2 - 1100.0**2
    asked = operating_range(with_requirements(operating=RANGE | {"rate_rad_s2": 50.0}))
    assert run_up_lengths(asked) == {50.0: pytest.approx(squares / (4.0 * np.pi * 50.0))}
    for rate, length in run_up_lengths(operating_range(with_requirements(operating=RANGE))).items():
        assert 2.0 * rate * 2.0 * np.pi * length == pytest.approx(squares)
    with pytest.raises(ConfigError, match="allowed: rates over 10 to 25000 revolutions of the judged range"):
        with_requirements(operating=RANGE | {"rate_rpm_s": 10.0}, requirements=YIELD)


def test_what_moves_no_run_runs_no_further_runs_again(with_requirements):
    """Neither a limit on the mass nor a dwell; a limit on runs does."""

    def params(needs, **operating):
        settings = with_requirements(operating=RANGE | operating, requirements=needs)
        stage = Judged(Sweep(settings)).looks()
        return stage.params["requirements"], stage.params["operating"]

    dwell = {"from_rad_s": 1150.0, "to_rad_s": 1160.0, "share_percent": 50.0}
    wanted = params(YIELD)
    assert params(YIELD | {"mass_at_most_kg": 1.0}, dwell=[dwell]) == wanted
    assert params({"above_yield_at_most_rad_s": 5.0}) != wanted


def test_the_clearance_is_the_smallest_of_a_run_that_changes_it(with_requirements):
    changing = replace(DIRECT.casing, clearance=4e-4, change_revolutions=(0.0, 5.0, 9.0), change=(0.0, -1e-4, 5e-5))
    settings = with_requirements(operating=RANGE)
    settings.scenes["direct"] = replace(settings.scenes["direct"], scene=replace(DIRECT, casing=changing))
    assert Judged(Sweep(settings)).known_of("Ref", "direct")["clearance"] == pytest.approx(3e-4)


def test_further_runs_that_take_too_long_are_left_out(with_requirements):
    """A thousand revolutions with the published step: 80 of them do not, 400 do."""
    asked = {"fidelity": "paper", "requirements": YIELD}
    for idle, reasons in ((1100.0, []), (300.0, ["no further runs, which take too long with steps of 1e-07 s"])):
        settings = with_requirements(operating=RANGE | {"idle_rad_s": idle}, **asked)
        assert list(Judged(Sweep(settings)).not_looked.values()) == reasons


def test_the_coarser_mesh_has_half_the_nodes(with_requirements):
    """Nor is it that of another tip line, or of a mesh that another program made."""
    settings = with_requirements()
    judged, place = Judged(Sweep(settings)), SimpleNamespace(blade="Ref", scene="direct")
    nodes = settings.fidelity.mesh.nodes // 2
    name = ModelChoice(nodes, 8, settings.fidelity.reduction.fixed_interface_modes).name
    folder = f"<results>/cases/Ref/{name}"
    assert judged.coarser_model(place) == {"coarser_contact": f"{folder}/contact.npz", "coarser_rom": f"{folder}/rom.nc"}
    other = with_requirements()
    other.scenes["direct"] = replace(other.scenes["direct"], tip_line="camber")
    assert Judged(Sweep(other)).coarser_model(place) == {}
