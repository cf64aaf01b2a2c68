"""The explorer: its contents against the datasets, and the page in a real browser."""

import base64
import gzip
import os

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from browser import opened

from r37core.explorer import write_page
from r37core.explorer.contents import explorer_contents, joined, order_bins, packed, rounded, stretches
from r37core.time_integration.status import RunStatus

SPEEDS = np.array([900.0, 1000.25, 1100.0, 1200.0, 1300.0])
BLADES, SCENES = ["Ref", "L<50>"], ["abradable", "direct"]


@pytest.fixture(scope="module")
def datasets():
    """Two blades in two scenes: one run has diverged, one was not asked for; only Ref in the lining has a history."""
    generator = np.random.default_rng(2)
    axes = {"blade": BLADES, "scene": SCENES, "speed": SPEEDS}
    status = np.zeros((2, 2, 5), dtype="i1")
    status[0, 1, 3], status[1, 0, 0] = RunStatus.DIVERGED, RunStatus.NOT_RUN
    missing = status > 0

    def over(*more):
        values = generator.uniform(1e-4, 1e-3, (2, 2, 5, *more))
        values[missing] = np.nan
        return values

    dims = ("blade", "scene", "speed")
    tip = {"tip_point": ["leading_edge", "trailing_edge"]}
    names = ("rms_normal", "rms_tangential", "peak_normal")
    rms = {name: ((*dims, "tip_point"), over(2)) for name in names}
    rms |= {"status": (dims, status), "share_of_time_in_contact": (dims, over())}
    history = np.full((2, 2, 1, 4), np.nan)
    history[0, 0, 0] = 1e8 * np.arange(1, 5)
    stress = {
        "max_von_mises": (dims, 1e12 * over()),
        "yield_stress": (dims[:2], np.full((2, 2), 1.38e9)),
        "max_von_mises_history": ((*dims[:2], "history_speed", "revolution"), history),
    }
    orders = np.arange(0.0, 4.001, 0.01)
    modes = {"blade": BLADES, "mode": ["1B", "1T"], "speed": np.linspace(0.0, 2000.0, 5), "engine_order": [1, 2, 3]}
    campbell = {
        "frequency": (("blade", "mode", "speed"), generator.uniform(500.0, 3000.0, (2, 2, 5))),
        "crossing_speed": (("blade", "mode", "engine_order"), np.array([[[np.nan, 1500.0, 800.0]] * 2] * 2)),
    }
    return {
        "rms": xr.Dataset(rms, axes | tip, {"fidelity": "draft"}),
        "campbell": xr.Dataset(campbell, modes),
        "stress": xr.Dataset(stress, axes | {"history_speed": [1000.25], "revolution": np.arange(1, 5)}),
        "spectrum": xr.Dataset({"amplitude": ((*dims, "engine_order"), over(len(orders)))}, axes | {"engine_order": orders}),
        # only one scene has a lining
        "wear": xr.Dataset(
            {
                "wear": ((*dims, "angle"), over(360)[:, :1]),
                "max_wear": (dims, over()[:, :1]),
            },
            axes | {"scene": ["abradable"], "angle": np.radians(np.arange(360))},
        ),
    }


@pytest.fixture(scope="module")
def interactions():
    row = {
        "blade": "Ref",
        "scene": "abradable",
        "mode": "1B",
        "engine_order": 4,
        "peak_speed_rad_s": 1200.0,
        "status": "completed",
    }
    other = row | {"scene": "direct", "mode": None, "engine_order": 2, "peak_speed_rad_s": 1000.25, "max_von_mises_pa": np.nan}
    return pd.DataFrame([row, other])


def unpacked(array):
    data = np.frombuffer(gzip.decompress(base64.b64decode(array["base64"])), dtype=f"<f{array['bits'] // 8}")
    return data.reshape(array["shape"])


def test_packing_keeps_shape_and_values():
    values = np.array([[1.0, np.nan, 3e-7], [1e9, -2.5, 0.0]])
    np.testing.assert_array_equal(unpacked(packed(values)), values.astype("f4"))
    np.testing.assert_array_equal(unpacked(packed(np.array([750.0000000001]), 64)), [750.0000000001])
    assert packed(values) == packed(values)


def test_rounding_of_maps():
    values = np.random.default_rng(1).uniform(1e-9, 1e3, 10_000)
    assert np.abs(rounded(values) / values - 1.0).max() < 6.2e-5
    assert np.isnan(rounded(np.array([np.nan])))[0]


def test_thinning_keeps_the_largest():
    values = np.array([1.0, np.nan, 5.0, 2.0, np.nan, np.nan])
    np.testing.assert_array_equal(joined(values, 0, stretches(6, 3)), [1.0, 5.0, np.nan])
    assert len(stretches(1251, 400)) <= 400
    np.testing.assert_array_equal(stretches(5, 400), np.arange(5))
    orders = np.arange(0.0, 1.001, 0.01)
    starts = order_bins(orders)
    assert len(starts) == 11
    # 0.94 belongs to 0.9, 0.95 to 1.0
    assert orders[starts[10]] == pytest.approx(0.95)


def test_contents_are_those_of_the_datasets(datasets, interactions):
    contents = explorer_contents(datasets, interactions)
    curves = {curve["name"]: curve for curve in contents["curves"]}
    rms = datasets["rms"]["rms_normal"].sel(tip_point="leading_edge")
    np.testing.assert_allclose(unpacked(curves["rms_normal"]["values"]), 1e3 * rms, rtol=1e-6)
    np.testing.assert_allclose(
        unpacked(curves["max_von_mises"]["values"]), 1e-6 * datasets["stress"]["max_von_mises"], rtol=1e-6
    )
    wear = unpacked(curves["max_wear"]["values"])
    np.testing.assert_allclose(wear[:, :1], 1e3 * datasets["wear"]["max_wear"], rtol=1e-6)
    assert np.isnan(wear[:, 1]).all()
    np.testing.assert_array_equal(unpacked(contents["speeds"]), SPEEDS)
    largest = datasets["spectrum"]["amplitude"].sel(engine_order=slice(1.95, 2.045)).max("engine_order")
    np.testing.assert_allclose(unpacked(contents["spectrum"]["values"])[..., 20], 1e3 * largest, rtol=1e-4)
    assert [one["engine_order"] for one in contents["published"]] == [4, 5, 6, 7]
    assert contents["interactions"][1]["mode"] is None


def test_interactions_that_have_a_shape(datasets, interactions):
    assert explorer_contents(datasets, interactions)["shapes"] == []
    assert explorer_contents(datasets, interactions, [("Ref", "abradable")])["shapes"] == [["Ref", "abradable"]]


def test_what_was_not_computed_is_left_out(datasets, interactions, tmp_path):
    contents = explorer_contents({name: datasets[name] for name in ("rms", "campbell")}, interactions.iloc[:0])
    assert contents["spectrum"] is contents["wear"] is contents["history"] is contents["yield_stress"] is None
    write_page(contents, "r37", tmp_path / "explorer.html")


@pytest.fixture(scope="module")
def page(datasets, interactions, tmp_path_factory):
    """The page in headless Chromium; a message in its console is an error."""
    file = tmp_path_factory.mktemp("explorer") / "explorer.html"
    write_page(explorer_contents(datasets, interactions, [("Ref", "abradable")]), "r37 <trial>", file)
    with opened(file, viewport={"width": 1500, "height": 1400}) as page:
        page.wait_for_selector("html[data-ready]", timeout=60_000)
        yield page
        assert page.problems == []
        folder = os.environ.get("R37_SCREENSHOTS")
        if folder:
            page.screenshot(path=f"{folder}/explorer.png", full_page=True)


def choose(page, **state):
    words = "&".join(f"{name}={value}" for name, value in state.items())
    page.evaluate("words => { window.location.hash = words; }", words)
    page.wait_for_function("words => decodeURIComponent(window.location.hash).includes(words)", arg=words.split("&")[-1])
    page.wait_for_timeout(200)


def traces(page, plot):
    return page.evaluate(
        "name => document.getElementById(name).data.map(one => ({ name: one.name, y: Array.from(one.y) }))", plot
    )


def hover(page, plot, curve, point):
    page.evaluate(
        "([name, curve, point]) => Plotly.Fx.hover(name, [{ curveNumber: curve, pointNumber: point }])", [plot, curve, point]
    )
    return page.text_content(f"#{plot} .hovertext")


@pytest.mark.slow
def test_the_page_loads_without_an_error(page):
    choose(page, blade="Ref", scene="abradable", quantity="rms_normal", speed="900", unit="rad/s", all="false")
    assert page.problems == []
    assert page.title() == "r37 <trial>"
    assert page.locator(".js-plotly-plot").count() == 5
    assert page.locator("#interactions tbody tr").count() == 2
    links = page.locator("#interactions a")
    assert [link.get_attribute("href") for link in links.all()] == ["shapes/Ref.html#scene=abradable&speed=1200"]


@pytest.mark.slow
def test_hover_says_what_the_dataset_has(page, datasets):
    choose(page, blade="Ref", scene="abradable", quantity="rms_normal", speed="900", unit="rad/s", all="false")
    value = 1e3 * float(
        datasets["rms"]["rms_normal"].sel(blade="Ref", scene="abradable", speed=1000.25, tip_point="leading_edge")
    )
    text = hover(page, "response", 0, 1)
    assert "1000.3 rad/s" in text
    assert "9551.7 rpm" in text
    assert f"{float(f'{value:.5g}'):g} mm"[:7] in text
    assert "completed" in text
    choose(page, blade="Ref", scene="abradable", quantity="max_von_mises", speed="900", unit="rad/s", all="false")
    value = 1e-6 * float(datasets["stress"]["max_von_mises"].sel(blade="Ref", scene="abradable", speed=1100.0))
    assert f"{float(f'{value:.5g}'):g} MPa" in hover(page, "response", 0, 2)


@pytest.mark.slow
def test_choices_change_what_is_drawn(page, datasets):
    choose(page, blade="Ref", scene="abradable", quantity="rms_normal", speed="900", unit="rad/s", all="false")
    ref = traces(page, "response")
    page.select_option("#blade", "L<50>")
    other = traces(page, "response")
    assert ref != other
    # not run at 900
    assert len(other[0]["y"]) == 4
    expected = 1e3 * datasets["rms"]["rms_normal"].sel(blade="L<50>", scene="direct", tip_point="leading_edge")
    np.testing.assert_allclose(other[1]["y"], expected, rtol=1e-6)
    page.select_option("#quantity", "max_von_mises")
    assert traces(page, "response") != other
    page.check("#all")
    assert [one["name"] for one in traces(page, "response")] == BLADES
    assert page.locator("#wear .js-plotly-plot, #wear.js-plotly-plot").count() == 1
    page.select_option("#scene", "direct")
    assert "Not computed for L<50> in direct" in page.text_content("#wear")
    page.select_option("#scene", "abradable")
    assert page.locator("#wear.js-plotly-plot").count() == 1
    # drawn anew, it is still listened to
    page.evaluate("document.getElementById('wear').emit('plotly_click', { points: [{ x: 1200 }] })")
    assert "1200 rad/s" in page.text_content("#now")


@pytest.mark.slow
def test_a_diverged_run_is_marked(page):
    choose(page, blade="Ref", scene="direct", quantity="rms_normal", speed="1200", unit="rad/s", all="false")
    assert "Ref diverged" in [one["name"] for one in traces(page, "response")]
    assert page.text_content("#now").endswith("none mm, diverged")


@pytest.mark.slow
def test_table_keys_and_clicks_move_the_speed(page):
    choose(page, blade="L<50>".replace("<", "%3C").replace(">", "%3E"), scene="direct", speed="900", unit="rad/s", all="false")
    page.click("#interactions tbody tr:nth-child(1)")
    assert page.text_content("#now").startswith("Ref, abradable, 1200 rad/s, 11459 rpm")
    assert "chosen" in page.get_attribute("#interactions tbody tr:nth-child(1)", "class")
    page.locator("h1").click()
    page.keyboard.press("ArrowRight")
    assert page.text_content("#now").startswith("Ref, abradable, 1300 rad/s")
    page.keyboard.press("ArrowRight")
    assert page.text_content("#now").startswith("Ref, abradable, 1300 rad/s")
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("s")
    assert page.text_content("#now").startswith("Ref, direct, 1200 rad/s")
    page.keyboard.press("u")
    assert page.input_value("#speed") == "11459"
    page.focus("#interactions tbody tr:nth-child(2)")
    page.keyboard.press("Enter")
    assert "1000.3 rad/s" in page.text_content("#now")
