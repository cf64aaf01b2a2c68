"""The explorer: its contents against the datasets, and the page in a real browser."""

import base64
import gzip

import numpy as np
import pytest
import xarray as xr
from browser import opened
from explorer_cases import BLADES, SPEEDS, beside, sweep

from r37core.config import command_line_document
from r37core.explorer import write_page
from r37core.explorer.contents import bin_starts, explorer_contents, joined, order_bins, packed, rounded
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import load_settings
from r37core.product.targets import links
from r37core.results.danger import danger_ranges
from r37core.results.datasets import response_of
from r37core.results.events import Danger
from r37core.results.exceedance import length_of
from r37core.results.limits import Cause
from r37core.time_integration.status import RunStatus

datasets = pytest.fixture(scope="module")(sweep)


def unpacked(array):
    data = np.frombuffer(gzip.decompress(base64.b64decode(array["base64"])), dtype=f"<f{array['bits'] // 8}")
    return data.reshape(array["shape"])


def test_packing_keeps_shape_and_values_and_rounding_their_first_digits():
    values = np.array([[1.0, np.nan, 3e-7], [1e9, -2.5, 0.0]])
    np.testing.assert_array_equal(unpacked(packed(values)), values.astype("f4"))
    np.testing.assert_array_equal(unpacked(packed(np.array([750.0000000001]), 64)), [750.0000000001])
    assert packed(values) == packed(values)
    # of maps, with fewer digits
    values = np.random.default_rng(1).uniform(1e-9, 1e3, 10_000)
    assert np.abs(rounded(values) / values - 1.0).max() < 6.2e-5
    assert np.isnan(rounded(np.array([np.nan])))[0]


def test_thinning_keeps_the_largest():
    values = np.array([1.0, np.nan, 5.0, 2.0, np.nan, np.nan])
    np.testing.assert_array_equal(joined(values, 0, bin_starts(6, 3)), [1.0, 5.0, np.nan])
    assert len(bin_starts(1251, 400)) <= 400
    np.testing.assert_array_equal(bin_starts(5, 400), np.arange(5))
    orders = np.arange(0.0, 1.001, 0.01)
    starts = order_bins(orders)
    assert len(starts) == 11
    # 0.94 belongs to 0.9, 0.95 to 1.0
    assert orders[starts[10]] == pytest.approx(0.95)


def test_contents_are_those_of_the_datasets(datasets):
    contents = explorer_contents(datasets)
    curves = {curve["name"]: curve for curve in contents["curves"]}
    rms = datasets["rms"]["rms_normal"].sel(tip_point="leading_edge")
    np.testing.assert_allclose(unpacked(curves["rms_normal"]["values"]), 1e3 * rms, rtol=1e-6)
    np.testing.assert_allclose(
        unpacked(curves["max_von_mises_ever"]["values"]), 1e-6 * datasets["stress"]["max_von_mises_ever"], rtol=1e-6
    )
    wear = unpacked(curves["max_wear"]["values"])
    np.testing.assert_allclose(wear[:, :1], 1e3 * datasets["wear"]["max_wear"], rtol=1e-6)
    assert np.isnan(wear[:, 1]).all()
    np.testing.assert_array_equal(unpacked(contents["speeds"]), SPEEDS)
    largest = datasets["spectrum"]["amplitude"].sel(engine_order=slice(1.95, 2.045)).max("engine_order")
    np.testing.assert_allclose(unpacked(contents["spectrum"]["values"])[..., 20], 1e3 * largest, rtol=1e-4)
    # only a linear model is left above yield
    assert contents["outside"] == "above yield: outside the linear model"
    quadratic = datasets | {"rms": datasets["rms"].assign_attrs(contact="11 patches, quadratic: Ref")}
    assert explorer_contents(quadratic)["outside"] == "above yield"


def test_what_was_not_computed_is_left_out(datasets, tmp_path):
    contents = explorer_contents({name: datasets[name] for name in ("rms", "campbell")})
    assert contents["spectrum"] is contents["wear"] is contents["history"] is contents["yield_stress"] is None
    assert contents["stress_region"] == {}
    write_page(contents, "r37", tmp_path / "explorer.html")


@pytest.fixture(scope="module")
def page(datasets, tmp_path_factory):
    """The page in headless Chromium; a message in its console is an error."""
    file = tmp_path_factory.mktemp("explorer") / "explorer.html"
    contents = explorer_contents(datasets)
    write_page(contents, "r37 <trial>", file)
    with opened(file, viewport={"width": 1500, "height": 1400}) as page:
        page.wait_for_selector("html[data-ready]")
        yield page
        assert page.problems == []


@pytest.fixture
def shown(page, tmp_path):
    """Opens a page of other datasets beside the first one; further arguments as of `beside`."""
    return lambda datasets, *more, **changes: beside(
        page, explorer_contents(datasets) | changes.pop("contents", {}), tmp_path / "explorer.html", *more, **changes
    )


CHOSEN = {"blade": "Ref", "scene": "abradable", "quantity": "rms_normal", "speed": "900", "unit": "rad/s", "all": "false"}


def choose(page, **state):
    """Choose CHOSEN but for what is given."""
    words = "&".join(f"{name}={value}" for name, value in (CHOSEN | state | {"asked": "yes"}).items())
    page.evaluate("words => { window.location.hash = words; }", words)
    # once all is drawn the page writes its state there, and no more than that
    page.wait_for_function("!window.location.hash.includes('asked')")
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def traces(page, plot):
    """Curves and maps of a plot, without the bars of dangerous and unknown speeds."""
    script = (
        "name => document.getElementById(name).data.filter(({ type }) => type !== 'bar')"
        ".map(({ name, x, y, text }) => ({ name, x, y: Array.from(y), text }))"
    )
    return page.evaluate(script, plot)


def curves(page):
    """Names of the curves of the response."""
    return [one["name"] for one in traces(page, "response")]


def hover(page, plot, curve, point):
    """What stands at a point, once it does: plotly leaves time between two of them."""
    at = [plot, curve, point]
    page.evaluate(
        "([name, curve, point]) => { document.getElementById(name)._hoverdata = undefined;"
        " Plotly.Fx.hover(name, [{ curveNumber: curve, pointNumber: point }]); }",
        at,
    )
    page.wait_for_function(
        "([name, curve, point]) => { const one = document.getElementById(name)._hoverdata?.[0];"
        " return one?.curveNumber === curve && one.pointNumber === point; }",
        arg=at,
    )
    return page.text_content(f"#{plot} .hovertext")


def test_the_page_loads_without_an_error(page):
    choose(page)
    assert page.problems == []
    assert curves(page) == ["abradable", "direct", "direct diverged"]
    assert page.title() == "r37 <trial>"
    assert page.locator(".js-plotly-plot").count() == 5
    assert page.is_visible("#stress")


def test_hover_says_what_the_dataset_has(page, datasets):
    choose(page)
    place = {"blade": "Ref", "scene": "abradable", "speed": 1000.25, "tip_point": "leading_edge"}
    value = 1e3 * float(datasets["rms"]["rms_normal"].sel(place))
    text = hover(page, "response", 0, 1)
    assert all(said in text for said in ("1000.3 rad/s", "9551.7 rpm", f"{float(f'{value:.5g}'):g} mm"[:7], "completed"))
    choose(page, quantity="max_von_mises_ever")
    value = 1e-6 * float(datasets["stress"]["max_von_mises_ever"].sel(blade="Ref", scene="abradable", speed=1100.0))
    assert f"{float(f'{value:.5g}'):g} MPa" in hover(page, "response", 0, 2)
    assert "x < 0.197 m" in page.text_content("#response .infolayer")
    choose(page, quantity="max_von_mises_ever", all="true")
    assert "regions of each blade" in page.text_content("#response .infolayer")


def test_choices_change_what_is_drawn(page, datasets):
    choose(page)
    ref = traces(page, "response")
    page.select_option("#blade", "L<50>")
    other = traces(page, "response")
    assert ref != other
    # not run at 900
    assert len(other[0]["y"]) == 4
    expected = 1e3 * datasets["rms"]["rms_normal"].sel(blade="L<50>", scene="direct", tip_point="leading_edge")
    np.testing.assert_allclose(other[1]["y"], expected, rtol=1e-6)
    page.select_option("#quantity", "max_von_mises_ever")
    assert traces(page, "response") != other
    page.check("#all")
    assert curves(page) == BLADES
    assert page.locator("#wear .js-plotly-plot, #wear.js-plotly-plot").count() == 1
    page.select_option("#scene", "direct")
    assert page.is_hidden("section:has(> #wear)")
    assert page.inner_text("#missing").startswith("Not computed for L<50> in direct: Wear, Stress of every revolution.")
    page.select_option("#scene", "abradable")
    assert page.locator("#wear.js-plotly-plot").count() == 1
    # drawn anew, it is still listened to
    page.evaluate("document.getElementById('wear').emit('plotly_click', { points: [{ x: 1200 }] })")
    assert "1200 rad/s" in page.text_content("#now")


def test_it_opens_at_the_worst_run(shown, datasets):
    """To have diverged is worse than any number, then the largest stress inside the model counts, or the motion without any."""
    with shown(datasets) as other:
        now = "Ref, direct, 1200 rad/s, 11459 rpm, diverged: beyond all that has a number"
        assert other.text_content("#now").startswith(now)
    rms = datasets["rms"].copy(deep=True)
    rms["status"] = rms["status"].where(rms["status"] != RunStatus.DIVERGED, RunStatus.COMPLETED)
    rms["rms_normal"].loc[{"blade": "L<50>", "scene": "direct", "speed": 900.0}] = 1.0
    stress = datasets["stress"].copy(deep=True)
    stress["max_von_mises_inside"].loc[{"blade": "L<50>", "scene": "abradable", "speed": 1000.25}] = 4.1e10
    for place, speed in (("", "1000.3 rad/s"), ("#speed=1200", "1200 rad/s")):
        with shown(datasets | {"rms": rms, "stress": stress}, place=place) as other:
            assert other.text_content("#now").startswith(f"L<50>, abradable, {speed}")
    with shown({"rms": rms, "campbell": datasets["campbell"]}) as other:
        assert other.text_content("#now").startswith("L<50>, direct, 900 rad/s")


@pytest.mark.parametrize("width", [390, 1400])
def test_it_fits_the_screen(shown, datasets, width):
    """Without scrolling sideways, and with plotly's buttons clear of what is drawn."""
    with shown(datasets, (width, 844), "#scene=abradable&quantity=share_of_time_in_contact&all=true") as other:
        assert other.evaluate("document.documentElement.scrollWidth") <= width
        for name in ("campbell", "response", "spectrum", "wear", "stress"):
            buttons, plot = (other.locator(f"#{name} {part}").first.bounding_box() for part in (".modebar", ".main-svg"))
            assert buttons["y"] + buttons["height"] <= plot["y"], name
            assert buttons["x"] + buttons["width"] <= width, name
            titles = {button.get_attribute("data-title") for button in other.locator(f"#{name} .modebar-btn").all()}
            assert titles == {"Download plot as a PNG", "Zoom", "Pan", "Reset axes"}
        assert other.locator("main > section:visible").count() == 6
        other.select_option("#scene", "direct")
        assert other.locator("main > section:visible h2").all_text_contents()[-1] == "Spectrum"
        # what is there takes the room of what is not
        other.wait_for_function("document.querySelector('#spectrum .main-svg').clientWidth > 0.9 * innerWidth")


def test_a_finger_has_room_and_scrolls_the_page_when_it_moves_over_a_plot(shown, datasets):
    """On a phone: nothing runs over the side, and controls are large enough."""
    with shown(datasets, (390, 844), is_mobile=True, has_touch=True) as other:
        assert other.evaluate("document.documentElement.scrollWidth") == 390
        assert min(one.bounding_box()["height"] for one in other.locator("#controls label:visible").all()) >= 44
        touches = other.context.new_cdp_session(other)

        def touch(kind, *heights):
            points = [{"x": 200, "y": height} for height in heights]
            touches.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

        middle = other.locator("#campbell .nsewdrag").bounding_box()
        start = middle["y"] + 0.5 * middle["height"]
        touch("touchStart", start)
        for moved in range(15, 240, 15):
            touch("touchMove", start - moved)
        touch("touchEnd")
        other.wait_for_function("scrollY > 100")


def test_modes_have_one_colour_each_and_those_beyond_the_axis_are_hidden(shown, datasets):
    campbell = datasets["campbell"].isel(mode=[0] * 9).assign_coords(mode=["1B", "1T", "2B", *map(str, range(4, 10))])
    rising = xr.DataArray(500.0 * np.arange(1, 10), dims="mode") + 0.1 * campbell["speed"]
    campbell["frequency"] = rising.expand_dims(blade=BLADES)
    with shown(datasets | {"campbell": campbell}) as other:
        drawn = other.evaluate(
            "() => document.getElementById('campbell').data.slice(1, -1)"
            ".map(one => [one.name, (one.line || one.marker).color ?? one.marker.color])"
        )
        # 3200 Hz of the sixth mode at the highest speed and a little are the top of the axis; the seventh begins above
        assert [name for name, _ in drawn[::2]] == ["1B", "1T", "2B", "mode 4", "mode 5", "mode 6"]
        assert drawn[::2] == drawn[1::2]
        assert len({colour for _, colour in drawn}) == 6


def test_engine_orders_end_at_the_border_with_their_numbers(shown, datasets):
    """Also where the diagram is zoomed: each line from border to border, its number where it leaves."""
    campbell = datasets["campbell"].copy(deep=True)
    campbell["frequency"][:] = 600.0
    drawn = (
        "() => { const { data } = document.getElementById('campbell');"
        " return [data[0], data.at(-1)].map(({ x, y, text }) => [x, y, text]); }"
    )
    numbers = "() => [...document.querySelectorAll('#campbell .textpoint')].map(one => one.textContent)"
    zoom = "Plotly.relayout('campbell', { 'xaxis.range': [1000, 1500], 'yaxis.range': [200, 400] })"
    with shown(datasets | {"campbell": campbell}) as other:
        # 630 Hz are the top; order 2 is below it at 2000 rad/s, order 3 above
        (x, y, _), (at, height, text) = other.evaluate(drawn)
        assert x[1::3] == pytest.approx([2000.0, 630.0 * np.pi, 420.0 * np.pi])
        assert [x[2], y[2]] == [None, None]
        assert (y[1::3], at, height) == (pytest.approx([1000.0 / np.pi, 630.0, 630.0]), x[1::3], y[1::3])
        assert text == other.evaluate(numbers) == ["1", "2", "3"]
        other.evaluate(zoom)
        other.wait_for_function("document.querySelectorAll('#campbell .textpoint').length === 2")
        (x, y, said), (at, _, text) = other.evaluate(drawn)
        assert [x[0], x[1], y[0], y[1]] == pytest.approx([400.0 * np.pi, 1500.0, 200.0, 750.0 / np.pi])
        assert (text, said[0]) == (["1", "2"], "engine order 1")
        assert at == pytest.approx([1500.0, 400.0 * np.pi])
        # another speed leaves it zoomed
        choose(other, speed="1100")
        assert other.evaluate(drawn)[1][2] == other.evaluate(numbers) == ["1", "2"]


def test_stress_above_yield_is_marked_as_outside_the_linear_model(shown, datasets):
    limits = datasets["stress"]["yield_stress"].copy()
    limits[0, 0] = 1e6
    outside, of_run = (
        "above yield: outside the linear model",
        datasets["stress"].sel(blade="Ref", scene="abradable", speed=1000.25),
    )
    ever, inside = (1e-6 * float(of_run[f"max_von_mises_{name}"]) for name in ("ever", "inside"))
    changed = datasets | {"stress": datasets["stress"].assign(yield_stress=limits)}
    with shown(changed, place="#scene=abradable&speed=1000.25") as other:
        assert other.text_content("#now").endswith(f"largest stress {ever:.5g} MPa, {inside:.5g} MPa inside the model")
        shapes = other.evaluate("document.getElementById('response').layout.shapes")
        across = [(one["name"], one["y0"]) for one in shapes if one["x1"] == 1]
        assert across == [(outside, 1), ("yield stress", 1)]


def test_header_table_and_bars_say_when_a_run_is_above_yield_and_when_it_leaves_the_model(shown, datasets):
    """First revolutions of both, the limit that is left; lengths of each kind by blade; a bar for each range."""
    stress, rms = (datasets[kind].copy(deep=True) for kind in ("stress", "rms"))
    here = {"blade": "Ref", "scene": "abradable", "speed": 900.0}
    stress["max_von_mises_inside"].loc[here] = 2.76e9
    for name, value in (("first_yield_revolution", 2.0), ("revolutions_above_yield", 70.0)):
        stress[name].loc[here] = value
    rms["exit_revolution"].loc[here], rms["exit_cause"].loc[here] = 5.0, Cause.FORCE
    stress["yield_danger"].loc[here] = Danger.DANGEROUS
    with shown(datasets | {"rms": rms, "stress": stress}, place="#blade=Ref&scene=abradable&speed=900") as other:
        now = other.text_content("#now")
        assert "above yield first in revolution 2, in 70 of all" in now and "leaves the model in revolution 5, by force" in now
        (dangerous, unknown) = danger_ranges(response_of(datasets | {"rms": rms, "stress": stress}, "Ref", "abradable"))
        lengths = [f"{length_of(parts):.3g}" for parts in (dangerous, unknown)]
        cells = other.locator("#danger tbody tr.chosen td").all_text_contents()
        assert cells[:3] == ["Ref", *lengths] and cells[4:] == ["2760", "heat"]
        bars = other.evaluate(
            "document.getElementById('response').data.filter(({ type }) => type === 'bar')"
            ".map(({ name, base, x, y }) => [name, ...[base, x, y].map((of) => Array.from(of))])"
        )
        found = {name: [row for row in zip(*rest, strict=True) if row[2] == "abradable"] for name, *rest in bars}
        for name, parts in (("dangerous", dangerous), ("unknown", unknown)):
            assert found[name] == [(pytest.approx(part.begin), pytest.approx(part.length), "abradable") for part in parts]
        other.locator("#danger button", has_text="L<50>").click()
        assert other.text_content("#now").startswith("L<50>, abradable")


def test_the_spectrum_shows_every_speed_on_its_own_scale(page, datasets):
    choose(page)
    shown = np.array(page.evaluate("document.getElementById('spectrum').data[0].z"), dtype=float)
    amplitude = datasets["spectrum"]["amplitude"].sel(blade="Ref", scene="abradable")
    starts = order_bins(amplitude["engine_order"].values)
    largest = np.maximum.reduceat(amplitude.values, starts, axis=1)
    expected = np.maximum(20.0 * np.log10(largest / largest[:, 1:].max(axis=1, keepdims=True)), -60.0)
    np.testing.assert_allclose(shown.T, expected, atol=2e-3)
    assert "mm" in page.evaluate("document.getElementById('spectrum').data[0].text[3][1]")


def test_tables_and_figures_are_linked_where_they_belong(page, shown, datasets, root):
    """Those of the chosen blade and scene, and those of several; a page without any has no line of them."""
    assert page.text_content("#links") == ""
    scenes = command_line_document({"abradable": {"rotor": {"blades": 2}, "results": ["stress"]}})
    search = {"blade": "Ref", "variables": {"thickness_percent": [90, 110]}, "objectives": {"direct": {"scenes": ["direct"]}}}
    changes = {"blades": ["Ref", "S50"], "scenes": ["abradable", "direct"], "fidelity": "draft", "search": search}
    settings = load_settings(command_line_document(changes), root, scenes_above=scenes)
    place = "#blade=Ref&scene=abradable&speed=900"
    with shown(datasets, contents={"links": links(Sweep(settings))}, place=place) as other:
        found = other.locator("#links a")
        names = ("interactions", "comparison_abradable", "ranking", "rotor_Ref__abradable", "search_designs")
        files = ["summary.csv", "ranking.csv", *(f"figures/{name}.png" for name in names)]
        assert [link.get_attribute("href") for link in found.all()] == files
        titles = ["summary.csv", "ranking.csv", "interactions", "around an interaction", "ranking"]
        assert found.all_text_contents() == [*titles, "rotors: rotor", "search: designs"]
        choose(other, scene="direct")
        assert found.all_text_contents() == [*titles, "search: designs"]


def test_a_diverged_run_is_marked(page, shown, datasets):
    """Above all that has a number, by its scene's or its blade's name; in a map, and where every run of a scene is one."""
    for every, name in (("false", "direct diverged"), ("true", "Ref diverged")):
        choose(page, scene="direct", speed="1200", all=every)
        drawn = {one["name"]: one for one in traces(page, "response")}
        finite = [y for other, one in drawn.items() if other != name for y in one["y"] if y is not None]
        assert drawn[name]["x"] == [1200] and drawn[name]["y"][0] > max(finite)
        assert drawn[name]["text"][0].endswith("diverged: beyond all that has a number")
    assert page.text_content("#now").endswith("rpm, diverged: beyond all that has a number")
    _, crosses = traces(page, "spectrum")
    assert crosses["x"] == [1200] and crosses["y"] == [4.0] and crosses["text"][0].endswith("<br>diverged")
    # a quantity that the scene does not compute has no runs at all
    choose(page, scene="direct", quantity="max_wear", speed="1200")
    assert curves(page) == ["abradable"]
    made, everywhere = {kind: data.copy(deep=True) for kind, data in datasets.items()}, {"blade": "L<50>", "scene": "direct"}
    made["rms"]["status"].loc[everywhere] = RunStatus.DIVERGED
    for name in ("rms_normal", "rms_tangential", "peak_normal"):
        made["rms"][name].loc[everywhere] = np.nan
    made["stress"]["max_von_mises_ever"].loc[everywhere] = np.nan
    with shown(made, place="#blade=L%3C50%3E&scene=direct") as other:
        drawn = {one["name"]: one for one in traces(other, "response")}
        assert drawn["direct diverged"]["x"] == SPEEDS.tolist()


def test_a_lining_that_is_worn_through_is_marked(shown, datasets):
    """In the map, and as a quantity of its own."""
    with shown(datasets, place="#scene=abradable&quantity=worn_through_share") as other:
        _, triangles = traces(other, "wear")
        assert (triangles["name"], triangles["x"]) == ("worn through", [1200])
        assert triangles["text"][0].endswith("worn through to the casing on 12.5% of the circumference")
        assert "0.125" in other.evaluate("document.getElementById('response').data[0].text[3]")


def test_keys_and_clicks_move_the_speed(page):
    """All cursors follow, without drawing the plots again."""
    choose(page)
    places = (
        "['campbell', 'response', 'spectrum', 'wear'].map(name => "
        "[...document.querySelectorAll(`#${name} .shapelayer path`)].map(path => path.getAttribute('d')))"
    )
    before = page.evaluate(places)
    page.evaluate("document.getElementById('response').emit('plotly_click', { points: [{ x: 1200 }] })")
    page.wait_for_function(f"before => {places}.every((of, at) => `${{of}}` !== `${{before[at]}}`)", arg=before)
    assert page.text_content("#now").startswith("Ref, abradable, 1200 rad/s, 11459 rpm")
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


def brightness(colour):
    """Relative luminance of rgb(...), 0 to 1."""
    values = [int(value) / 255 for value in colour.removeprefix("rgb(").rstrip(")").split(",")[:3]]
    linear = [value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4 for value in values]
    return float(np.dot([0.2126, 0.7152, 0.0722], linear))


def test_it_is_dark_where_that_is_preferred(shown, datasets):
    """Page and plots, with contrast; and changes with the preference."""
    with shown(datasets, color_scheme="dark") as other:
        styles = "[...document.querySelectorAll(place)].map(one => getComputedStyle(one)[name])"

        def of(place, name):
            return [brightness(one) for one in other.evaluate(f"([place, name]) => {styles}", [place, name])]

        backgrounds = of("html, header, .main-svg:first-child", "backgroundColor")
        texts = of("#now, footer", "color") + of(".plot .xtick text, .plot .ytick text, .plot .g-ytitle text", "fill")
        assert len(texts) > 20
        assert (min(texts) + 0.05) / (max(backgrounds) + 0.05) > 4.5
        other.emulate_media(color_scheme="light")
        other.wait_for_function("document.getElementById('campbell').layout.paper_bgcolor === '#ffffff'")
        assert min(of("html, .main-svg:first-child", "backgroundColor")) == pytest.approx(1.0)
