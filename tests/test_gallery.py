"""The gallery: what the lines under its figures say, and the page that is in the repository."""

import re

import numpy as np
import pytest
import xarray as xr

from r37core.config import ConfigError, command_line_document, read_settings
from r37core.figures.captions import CAPTIONS
from r37core.plans.sweep_plan import Sweep
from r37core.published import BLADES, DIRECT_PEAK, INTERACTIONS, QUIET
from r37core.studies.check import Check, claim
from r37core.studies.gallery import COARSE, FINE, ITEMS, Item, history_speeds, of_item, run_of, verdict
from r37core.studies.gallery_plan import Gallery
from r37core.time_integration.status import RunStatus


def test_verdicts_name_what_agrees_and_what_does_not():
    few = [Check("peak", 100.0, 100.4, "rad/s"), Check("width", 17.0, 25.0, "rad/s", 0.2), claim("low above", True, "30%")]
    assert verdict(few) == (
        "**Agrees** (2 of 3): peak 100.4 rad/s (published 100); low above (30%). "
        "**Does not agree**: width 25 rad/s (published 17)."
    )
    many = [Check(f"area {number}", 1.0, 1.0 + 1e-3 * number, "cm2") for number in range(6)] + [claim("true", True)]
    assert verdict(many) == (
        "**Agrees** (7 of 7): 6 numbers, the largest difference 0.5%, area 5 1.005 cm2 (published 1) and 1 statement."
    )
    assert verdict([Check("ours", None, 3.0, "Hz")]) == "Ours alone: ours 3 Hz."


def test_checks_go_to_their_figures():
    checks = [Check(f"{blade} 1B/4: {what}", 1.0, 1.0) for blade in ("Ref", "S50") for what in ("Campbell", "peak")]
    found = {item.name: [check.name for check in of_item(item, checks)] for item in ITEMS}
    assert found["campbell"] == ["Ref 1B/4: Campbell"]
    assert found["variants"] == ["S50 1B/4: Campbell"]
    assert found["variants_response"] == ["S50 1B/4: peak"]
    assert of_item(Item("a", "A", ("^none",)), checks) == []


def test_every_figure_has_a_caption():
    assert {item.name for item in ITEMS if not item.name.startswith("spectrum_")} <= set(CAPTIONS)
    assert FINE % COARSE == 0


@pytest.fixture
def datasets():
    """One blade in one scene at speeds of which one was not run; the largest motion at 1690 rad/s, with four lobes."""
    speeds = np.array([1600.0, 1680.0, 1690.0, 1700.0, 1800.0])
    axes = {"blade": ["Ref"], "scene": ["lined"], "speed": speeds}
    dims = ("blade", "scene", "speed")
    status = np.array([[[0, 0, 0, RunStatus.NOT_RUN, 0]]])
    rms = xr.Dataset({"status": (dims, status), "casing_hits": (dims, status)}, axes | {"tip_point": ["leading_edge", "t"]})
    for direction in ("normal", "radial", "tangential"):
        values = np.array([1e-4, 2e-3, 5e-3, np.nan, 1e-4])[None, None, :, None] * [1.0, 9.0]
        rms[f"rms_{direction}"] = ((*dims, "tip_point"), values)
    contact = np.zeros((1, 1, 5, 4, 2))
    contact[..., 2:, 0] = 1e-4
    rms["revolution_maximum"] = ((*dims, "revolution", "tip_point"), contact)
    harmonics = np.zeros((1, 1, 5, 21))
    harmonics[..., 2], harmonics[..., 4] = 9.0, 1.0
    wear = xr.Dataset(
        {"max_wear": (dims, 1e-3 * np.ones((1, 1, 5))), "wear_harmonic": ((*dims, "lobes"), harmonics)},
        axes | {"lobes": np.arange(21)},
    )
    return {"rms": rms, "wear": wear}


def test_a_sweep_is_read_as_a_run_of_the_studies(datasets):
    run = run_of(datasets, "Ref", "lined")
    np.testing.assert_array_equal(run["speed"], [1600.0, 1680.0, 1690.0, 1800.0])
    assert float(run["rms_normal"].sel(speed=1690.0)) == 5e-3
    # two lobes are the casing's own
    assert set(run["lobes"].values) == {4.0}
    assert set(run["first_contact"].values) == {3.0}
    assert "max_von_mises" not in run


def test_histories_are_at_the_published_speeds_and_at_our_peak(datasets):
    run = run_of(datasets, "Ref", "lined")
    assert history_speeds(run, "Ref", lined=True) == sorted([DIRECT_PEAK, 1690.0, INTERACTIONS[0].peak, QUIET])
    assert history_speeds(run, "Ref", lined=False) == sorted([DIRECT_PEAK, INTERACTIONS[0].peak, QUIET])
    assert history_speeds(run, "S50", lined=True) == [1690.0]


def test_a_sweep_without_the_benchmark_is_refused(root, settings):
    plan = Gallery(Sweep(settings))
    assert len(plan.inputs(None)["histories"]) == len(BLADES) + 1
    assert plan.yield_stress(None) == 1.38e9
    few = Gallery(Sweep(read_settings(root, command_line_document({"blades": ["Ref"], "scenes": ["abradable"]}))))
    with pytest.raises(ConfigError, match=r"the gallery needs L50, .*CS100, direct, which this run leaves out"):
        few.inputs(None)
    # whose other rules are planned all the same
    other = Gallery(Sweep(read_settings(root, command_line_document({"blades": ["L50"]}))))
    assert other.pictures
    for asked in (other.submesh, other.yield_stress):
        with pytest.raises(ConfigError, match="the gallery needs Ref"):
            asked(None)


def test_the_page_has_every_figure(root):
    page = (root / "docs/gallery.md").read_text()
    pictures = re.findall(r"\((gallery/\w+\.png)\)", page)
    assert pictures == [f"gallery/{item.name}.png" for item in ITEMS]
    assert sum((root / "docs" / picture).stat().st_size for picture in pictures) < 2_000_000
    assert not re.search(r"\bnan\b", page)
