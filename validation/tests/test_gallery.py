"""The gallery: what the lines under its figures say, and the page that is in the repository."""

import re

import numpy as np
import pytest
import xarray as xr
from r37core.studies.runner import with_swept_peak

from r37core.config import ConfigError, command_line_document
from r37core.product.reading import read_settings
from r37core.product.reporting import CAPTIONS
from validation.published import BLADES, DIRECT_PEAK, INTERACTIONS, QUIET
from validation.studies.checks import Check, claim
from validation.studies.gallery.captions import CAPTIONS as OWN_CAPTIONS
from validation.studies.gallery.cases import COARSE, FINE, ITEMS, Item, cases, inputs, outputs, values
from validation.studies.gallery.report import of_item, verdict


def test_verdicts_name_what_agrees_and_what_does_not():
    few = [Check("peak", 100.0, 100.4, "rad/s"), Check("width", 17.0, 25.0, "rad/s", 0.2), claim("low above", True, "30%")]
    assert verdict(few) == (
        "**Agrees** (2 of 3):\n\n- peak 100.4 rad/s (published 100)\n- low above (30%)\n\n"
        "**Does not agree**:\n\n- width 25 rad/s (published 17)"
    )
    many = [Check(f"area {number}", 1.0, 1.0 + 1e-3 * number, "cm2") for number in range(6)] + [claim("true", True)]
    assert verdict(many) == (
        "**Agrees** (7 of 7):\n\n- 6 numbers, the largest difference 0.5%, area 5 1.005 cm2 (published 1) and 1 statement"
    )
    assert verdict([Check("ours", None, 3.0, "Hz")]) == "Ours alone:\n\n- ours 3 Hz"


def test_checks_go_to_their_figures():
    checks = [Check(f"{blade} 1B/4: {what}", 1.0, 1.0) for blade in ("Ref", "S50") for what in ("Campbell", "peak")]
    found = {item.name: [check.name for check in of_item(item, checks)] for item in ITEMS}
    assert found["campbell"] == ["Ref 1B/4: Campbell"]
    assert found["variants"] == ["S50 1B/4: Campbell"]
    assert found["variants_response"] == ["S50 1B/4: peak"]
    assert of_item(Item("a", "A", ("^none",)), checks) == []


def test_every_figure_has_a_caption():
    assert {item.name for item in ITEMS if not item.name.startswith("spectrum_")} <= {*CAPTIONS, *OWN_CAPTIONS}
    assert FINE % COARSE == 0


@pytest.fixture
def response():
    """One blade in one scene; the largest motion at 1690 rad/s."""
    speeds = np.array([1600.0, 1680.0, 1690.0, 1800.0])
    values = np.array([1e-4, 2e-3, 5e-3, 1e-4])[:, None] * [1.0, 9.0]
    data = {f"rms_{direction}": (("speed", "tip_point"), values) for direction in ("normal", "radial", "tangential")}
    return xr.Dataset(data, {"speed": speeds, "tip_point": ["leading_edge", "trailing_edge"]})


def test_histories_are_at_the_published_speeds_and_at_our_peak(response, settings):
    planned = cases(settings)
    published = sorted([DIRECT_PEAK, INTERACTIONS[0].peak, QUIET])

    def speeds(name):
        return list(with_swept_peak(planned[name], planned[name].swept_peak, response).speeds)

    assert speeds("Ref__lined") == sorted([*published, 1690.0])
    assert list(planned["Ref__direct"].speeds) == published
    assert planned["Ref__direct"].swept_peak is None
    assert speeds("S50__lined") == [1690.0]
    assert planned["revolution"].choice.snapshots_per_revolution == FINE


def test_a_sweep_without_the_benchmark_is_refused(root, settings):
    assert len(inputs(settings)["responses"]) == len(BLADES) + 1
    few = read_settings(root, command_line_document({"blades": ["Ref"], "scenes": ["abradable"]}))
    with pytest.raises(ConfigError, match=r"the gallery needs L50, .*CS100, direct, which this run leaves out"):
        inputs(few)
    # whose other rules are planned all the same
    other = read_settings(root, command_line_document({"blades": ["L50"]}))
    assert outputs(other)
    for asked in (cases, values):
        with pytest.raises(ConfigError, match="the gallery needs Ref"):
            asked(other)


def test_the_page_has_every_figure(root):
    page = (root / "docs/gallery.md").read_text()
    pictures = re.findall(r"\((gallery/\w+\.png)\)", page)
    assert pictures == [f"gallery/{item.name}.png" for item in ITEMS]
    assert sum((root / "docs" / picture).stat().st_size for picture in pictures) < 2_000_000
    assert not re.search(r"\bnan\b", page)
