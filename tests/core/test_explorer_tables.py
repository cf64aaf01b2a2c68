"""The explorer's tables: interactions of what is chosen, their words, and which blade is the best; and light and dark."""

from itertools import pairwise

import numpy as np
import pandas as pd
import pytest
from browser import opened
from explorer_cases import beside, interaction_rows, sweep

from r37core.explorer import FOLDER, page_parts, write_page
from r37core.explorer.contents import explorer_contents
from r37core.results.columns import RANKING as RANKING_COLUMNS
from r37core.results.columns import SUMMARY, column_named
from r37studies.designs.panel import contents as design_panel

RANKING = pd.DataFrame(
    [
        ("L<50>", "abradable", 1, 10.0, 20.0, 22.0, 5.0, 12.0, 4e9, 0.75),
        ("Ref", "abradable", 2, 30.2, 60.0, 80.0, 20.0, 45.0, 9e9, np.nan),
        ("Ref", "direct", 1, 0.0, 100.0, 110.0, np.nan, np.nan, 2e9, np.nan),
        ("L<50>", "direct", 1, 50.0, 55.0, 56.0, np.nan, np.nan, 3e9, 0.25),
    ],
    columns=[
        "blade", "scene", "rank", "length_most_revolutions_rad_s", "length_some_revolutions_rad_s", "length_ever_rad_s",
        "length_most_revolutions_rad_s_low", "length_most_revolutions_rad_s_high",
        "largest_median_stress_pa", "chance_better_than_Ref",
    ],
)  # fmt: skip


@pytest.fixture(scope="module")
def rows():
    """Of Ref in the lining the benchmark's 1B/4, one whose largest stress is not at its peak, another; two elsewhere."""
    first = interaction_rows().iloc[0].to_dict() | {"drop": 0.5, "largest_stress_speed_rad_s": 1200.0, "largest_stress_pa": 5e8}
    other = first | {"mode": "1T", "engine_order": 12, "peak_speed_rad_s": 1000.25, "drop": np.nan, "largest_stress_pa": 14e9}
    third = first | {"mode": "1T", "engine_order": 9, "peak_speed_rad_s": 1300.0, "drop": 0.9}
    direct = first | {"scene": "direct", "peak_speed_rad_s": 1100.0}
    return pd.DataFrame([first, other, third, direct, first | {"blade": "L<50>"}])


@pytest.fixture(scope="module")
def page(rows, tmp_path_factory):
    file = tmp_path_factory.mktemp("explorer") / "explorer.html"
    write_page(explorer_contents(sweep(), rows, ranking=RANKING), "r37", file)
    with opened(file, viewport={"width": 1400, "height": 1000}) as page:
        page.wait_for_selector("html[data-ready]")
        yield page
        assert page.problems == []


@pytest.fixture
def at_ref(page):
    """The page with Ref in the lining, at a speed of no interaction."""
    page.evaluate("location.hash = 'blade=Ref&scene=abradable&quantity=rms_normal&speed=900&unit=rad/s&sort=&columns=true'")
    page.wait_for_function("document.getElementById('now').textContent.startsWith('Ref, abradable, 900 rad/s')")
    return page


def column(page, name):
    return page.locator(f"#interactions tbody td.{name}").all_text_contents()


def test_every_column_has_words():
    """And the unit of what it shows: one declaration for the page and its tooltips."""
    for end, said in (("rad_s_low", "5%"), ("rad_s_median", "median"), ("scatter_rad_s", "scatter")):
        titled = column_named(f"length_most_revolutions_{end}", RANKING_COLUMNS)
        assert titled.title == f"above yield in most revolutions, {said}"
    assert column_named("chance_better_than_L50", RANKING_COLUMNS).title == "chance to be better than L50"
    assert column_named("never_heard_of", RANKING_COLUMNS) is None
    columns = [column_named(name, SUMMARY) for name in ("blade", "peak_rms_normal_m", "largest_stress_pa", "drop")]
    assert [(column.unit, column.factor) for column in columns] == [("", 1.0), ("mm", 1e3), ("MPa", 1e-6), ("%", 100.0)]
    assert columns[0].title == "blade"


def test_contents_have_the_ranking(rows):
    contents = explorer_contents(sweep(), rows, ranking=RANKING.assign(unheard_of=1.0))
    assert contents["ranking"][1]["length_most_revolutions_rad_s"] == 30.0
    assert contents["ranking"][2]["length_most_revolutions_rad_s_low"] is None
    assert "unheard_of" not in [one["name"] for one in contents["ranking_columns"]]
    assert explorer_contents(sweep(), rows)["ranking"] is None


def test_the_table_has_the_rows_of_what_is_chosen(at_ref):
    assert column(at_ref, "interaction") == ["1B/4", "1T/12", "1T/9"]
    assert at_ref.text_content("#shown") == "3 of Ref in abradable"
    at_ref.check("#all")
    assert column(at_ref, "blade") == ["Ref"] * 3 + ["L<50>"]
    at_ref.check("#every")
    assert len(column(at_ref, "blade")) == 5
    assert "every=true" in at_ref.url
    at_ref.uncheck("#every")
    at_ref.uncheck("#all")
    at_ref.select_option("#blade", "L<50>")
    at_ref.select_option("#scene", "direct")
    assert at_ref.text_content("#shown") == "none of L<50> in direct"
    assert at_ref.is_hidden("#interactions table")


def test_a_click_on_a_head_sorts_and_says_what_it_is(at_ref):
    """And Enter does; what has no number stays last."""
    head = at_ref.locator("#interactions th.drop")
    lost = head.locator("button")
    assert lost.text_content() == "amplitude lost above the peak (%)"
    assert lost.get_attribute("title").startswith("amplitude lost above the peak: share of the amplitude lost within 24 rad/s")
    lost.click()
    assert column(at_ref, "drop") == ["50", "90", ""]
    assert head.get_attribute("aria-sort") == "ascending"
    assert at_ref.locator("section:has(#interactions) .meaning").text_content() == lost.get_attribute("title")
    lost.press("Enter")
    assert column(at_ref, "drop") == ["90", "50", ""]
    assert head.get_attribute("aria-sort") == "descending"
    assert "sort=-drop" in at_ref.url
    lost.press("Enter")
    assert column(at_ref, "drop") == ["50", "", "90"]
    at_ref.locator("#interactions th.interaction button").click()
    assert column(at_ref, "interaction") == ["1B/4", "1T/9", "1T/12"]


def test_quantities_and_the_two_stresses_have_long_names_and_speeds_the_chosen_unit(at_ref):
    at_ref.click("#interactions tbody tr:has-text('1T/12')")
    now = at_ref.text_content("#now")
    assert now.startswith("Ref, abradable, 1000.3 rad/s")
    assert now.endswith("; interaction 1T/12: largest stress 14000 MPa at 1200 rad/s, 11459 rpm")
    assert "largest stress (MPa)" in at_ref.locator("#interactions th").all_text_contents()
    at_ref.click("#interactions tbody tr:has-text('1B/4')")
    assert "interaction" not in at_ref.text_content("#now")
    options = at_ref.locator("#quantity option").all_text_contents()
    assert "largest von Mises stress of each of the later revolutions: largest (MPa)" in options
    assert "share of the steps with a contact force" in options
    at_ref.select_option("#unit", "rpm")
    assert "peak speed (rpm)" in at_ref.locator("#interactions th").all_text_contents()
    assert column(at_ref, "peak_speed_rad_s")[0] == "11459"
    assert "above yield in most revolutions (rpm)" in at_ref.text_content("#keys")


def test_details_are_columns_on_request(at_ref):
    """And the one by which rows are sorted."""
    assert at_ref.is_visible("#interactions th.drop")
    at_ref.uncheck("#columns")
    assert at_ref.is_hidden("#interactions th.drop")
    assert at_ref.is_visible("#interactions th.largest_stress_pa")
    at_ref.evaluate("location.hash = 'columns=false&sort=-drop'")
    at_ref.wait_for_selector("#interactions th.drop[aria-sort='descending']")
    assert column(at_ref, "drop") == ["90", "50", ""]


def test_a_step_in_speed_moves_the_cursors(at_ref):
    """Without drawing the plots anew."""
    places = (
        "['campbell', 'response', 'spectrum', 'wear'].map(name => "
        "[...document.querySelectorAll(`#${name} .shapelayer path`)].map(path => path.getAttribute('d')))"
    )
    before = at_ref.evaluate(places)
    at_ref.locator("h1").click()
    at_ref.keyboard.press("ArrowRight")
    at_ref.wait_for_function(f"before => {places}.every((of, at) => `${{of}}` !== `${{before[at]}}`)", arg=before)


def test_which_blade(at_ref):
    """By rank in the first scene; the lengths of the bars are those of the table, and a click goes to a blade and scene."""
    assert at_ref.locator("#bars tbody th").all_text_contents() == ["L<50>", "Ref"]
    lines = at_ref.locator("#bars tbody tr").nth(1)
    assert lines.locator(".rank").all_text_contents() == ["2", "1 ="]
    assert lines.locator(".numbers").all_text_contents() == ["30 / 60 / 80", "0 / 100 / 110"]
    line, range_, *bars = (
        lines.locator(f"td:nth-of-type(1) .{name}").first.bounding_box()
        for name in ("bar", "range", "certain", "possible", "ever")
    )
    shares = [bar["width"] / line["width"] for bar in bars]
    assert shares == pytest.approx([30 / 80, 60 / 80, 1.0], rel=0.02)
    assert range_["x"] - line["x"] == pytest.approx(20 / 80 * line["width"], rel=0.02)
    assert range_["width"] == pytest.approx(25 / 80 * line["width"], rel=0.02)
    at_ref.click("#numbers-of")
    numbers = [line.locator("th, td").all_text_contents() for line in at_ref.locator("#numbers tbody tr").all()]
    assert ["median stress (MPa)", "9000", "2000"] in numbers
    at_ref.locator("#bars tbody tr").nth(0).locator("td").nth(1).click()
    assert at_ref.text_content("#now").startswith("L<50>, direct")
    assert at_ref.text_content("#numbers-of") == "All numbers of L<50>"
    numbers = [line.locator("th, td").all_text_contents() for line in at_ref.locator("#numbers tbody tr").all()]
    assert ["chance to be better than Ref (%)", "75", "25"] in numbers
    at_ref.locator("#bars button", has_text="Ref").press("Enter")
    assert at_ref.text_content("#now").startswith("Ref, direct")
    assert at_ref.locator("#bars tr.chosen td.here").count() == 1


def judged(*verdicts):
    """Panel of the requirements with rows: blade, scene, verdict on the length above yield, of which 24 rad/s are allowed."""
    names = ("blade", "scene", "verdict")
    numbers = {"requirement": "above_yield", "limit": 24.0, "value": 1.0, "margin": 1.0, "unit": "rad/s"}
    numbers |= {"certainty": "", "note": "", "from_rad_s": None, "to_rad_s": None}
    rows = [dict(zip(names, row, strict=True)) | numbers for row in verdicts]
    return {"requirements": {"pairs": [], "requirements": rows}}


def test_the_ranking_shows_the_worst_motion_and_the_limit(page, rows, tmp_path):
    """Thin bars, with the length from rest and the limit on them, each named in the key; without them neither bar nor name."""
    worst = [f"length_most_revolutions_{name}_rad_s" for name in ("worst", "rest", "operating")]
    more = RANKING.assign(**dict(zip(worst, ([15.0, 45.0, np.nan, np.nan], [6.0, 30.0, np.nan, np.nan], 12.0), strict=True)))
    contents = explorer_contents(sweep(), rows, ranking=more) | {"panels": judged(("Ref", "abradable", "fails"))}
    parts = page_parts([FOLDER.parent / "requirements/panel.js"])
    with beside(page, contents, tmp_path / "explorer.html", parts=parts) as other:
        cell = other.locator("#bars tbody tr").nth(1).locator("td:nth-of-type(1)")
        boxes = {name: cell.locator(f".{name}").bounding_box() for name in ("worst", "rest", "inside", "limit")}
        line = cell.locator(".bar").first.bounding_box()
        assert boxes["worst"]["width"] == pytest.approx(45 / 80 * line["width"], rel=0.02)
        assert boxes["inside"]["width"] == pytest.approx(12 / 80 * line["width"], rel=0.02)
        places = [(boxes[name]["x"] - line["x"]) / line["width"] for name in ("rest", "limit")]
        assert places == pytest.approx([30 / 80, 24 / 80], abs=0.01)
        assert other.locator("#keys button").all_text_contents()[4:] == [
            "above yield in most revolutions, worst motion (rad/s)", "above yield in most revolutions, in operation (rad/s)",
            "above yield in most revolutions, from rest (rad/s)", "limit in operation (rad/s)",
        ]  # fmt: skip
        assert cell.locator(".numbers").text_content() == "30 / 60 / 80"
    with beside(page, explorer_contents(sweep(), rows, ranking=more.drop(columns=worst[:2])), tmp_path / "other.html") as other:
        assert other.locator("#bars .thin").count() == 0
        assert len(other.locator("#keys button").all()) == 4


def test_the_map_of_designs_has_the_line_of_a_requirement(page, rows, tmp_path):
    """Round the design that does not fail it, which has a mark; a step in speed leaves the line where it is."""
    keys = ["scene.casing.clearance_m", "scene.lining.thickness_m"]
    places = [(clearance, thickness) for clearance in (3e-4, 6e-4) for thickness in (0.001, 0.002)]
    designs = pd.DataFrame([("Ref", f"Room_{number}", "Room", *place) for number, place in enumerate(places)])
    table = designs.set_axis(["blade", "scene", "family", *keys], axis=1).assign(
        length_most_revolutions_rad_s=[40.0, 30, 20, 0], share_of_revolutions_above_yield=[0.9, 0.8, 0.7, 0.1]
    )
    verdicts = [("Ref", f"Room_{number}", verdict) for number, verdict in enumerate(("fails", "fails", "fails", "meets"))]
    contents = explorer_contents(sweep(), rows) | {"panels": {"designs": design_panel(table)} | judged(*verdicts)}
    parts = page_parts([FOLDER.parent / f"{name}/panel.js" for name in ("designs", "requirements")])
    with beside(page, contents, tmp_path / "explorer.html", place="#blade=Ref&scene=abradable&speed=900", parts=parts) as other:
        map_ = "document.getElementById('designs')"
        sides = f"{map_}.layout.shapes.map(one => [one.x0, one.y0, one.x1, one.y1])"
        assert sorted(other.evaluate(sides)) == [[0.5, 0.5, 0.5, 1.5], [0.5, 0.5, 1.5, 0.5]]
        assert other.evaluate(f"{map_}.data[0].text") == [["40", "20"], ["30", "0 \u25c7 \u2713"]]
        assert "limit of above yield" in other.text_content("#designs .legend")
        other.locator("h1").click()
        other.keyboard.press("ArrowRight")
        assert "1000.3 rad/s" in other.text_content("#now")
        assert [0.5, 0.5, 0.5, 1.5] in other.evaluate(sides)


@pytest.mark.parametrize("width", [390, 1400])
def test_each_of_six_scenes_has_bars_and_a_name(page, rows, tmp_path, width):
    """The reason of a verdict stands on the screen, too."""
    names = [f"a_scene_with_a_long_name_{number}" for number in range(6)]
    datasets = {kind: data for kind, data in sweep().items() if kind != "wear"}
    of_scenes = ("rms", "stress", "spectrum")
    many = datasets | {kind: datasets[kind].isel(scene=[0] * 6).assign_coords(scene=names) for kind in of_scenes}
    ranking = pd.concat([RANKING[RANKING["scene"] == "abradable"].assign(scene=name) for name in names])
    panel = judged(("Ref", names[0], "fails"))
    panel["requirements"]["pairs"] = [{"blade": "Ref", "scene": names[0], "verdict": "fails", "reason": "too long " * 12}]
    contents = explorer_contents(many, rows.iloc[:0], ranking=ranking) | {"panels": panel}
    parts = page_parts([FOLDER.parent / "requirements/panel.js"])
    with beside(page, contents, tmp_path / "explorer.html", (width, 844), parts=parts) as other:
        bars = [bar.bounding_box()["width"] for bar in other.locator("#bars .bars").all()]
        assert len(bars) == 12 and min(bars) > (30 if width == 390 else 100)
        heads = [head.bounding_box() for head in other.locator("#bars thead th").all()]
        assert all(one["x"] + one["width"] <= following["x"] + 1 for one, following in pairwise(heads))
        over = "[...document.querySelectorAll('#bars thead th')].some(head => head.scrollWidth > head.clientWidth + 1)"
        assert not other.evaluate(over)
        assert heads[0]["width"] > 50
        reason = other.locator("#verdict td:last-child").bounding_box()
        assert reason["x"] + reason["width"] <= width


def test_a_ranking_without_some_columns(page, rows, tmp_path):
    short = RANKING[["blade", "scene", "length_some_revolutions_rad_s"]]
    with beside(page, explorer_contents(sweep(), rows, ranking=short), tmp_path / "explorer.html") as other:
        assert other.locator("#bars .certain, #bars .rank").count() == 0
        assert other.locator("#bars .possible").count() == 4
        assert other.locator("#keys button").all_text_contents() == ["above yield in some revolutions (rad/s)"]


def test_a_finger_finds_all(page, rows, tmp_path):
    """On a phone: nothing runs over the side, controls have room, a tap says what a column is, tables scroll in their box."""
    contents = explorer_contents(sweep(), rows, ranking=RANKING)
    phone = {"is_mobile": True, "has_touch": True}
    with beside(page, contents, tmp_path / "explorer.html", (390, 844), "#scene=abradable&columns=true", **phone) as other:
        assert other.evaluate("document.documentElement.scrollWidth") == 390
        wanted = "#controls label:visible, #interactions th:visible button, #bars tbody th button, section > label, summary"
        sizes = [one.bounding_box()["height"] for one in other.locator(wanted).all()]
        assert len(sizes) > 10
        assert min(sizes) >= 44
        assert other.evaluate("(box => box.scrollWidth > box.clientWidth)(document.getElementById('interactions'))")
        button = other.locator("#interactions th.drop button")
        button.tap()
        assert other.locator("section:has(#interactions) .meaning").text_content() == button.get_attribute("title")
        first = other.locator("#interactions tbody tr:first-child td.interaction")
        assert first.bounding_box()["x"] < 20
        bars, numbers = (
            other.locator(f"#bars tbody tr:first-child td:nth-of-type(1) .{name}").bounding_box()
            for name in ("bars", "numbers")
        )
        assert bars["y"] + bars["height"] <= numbers["y"] + 1


def brightness(colour):
    """Relative luminance of rgb(...), 0 to 1."""
    values = [int(value) / 255 for value in colour.removeprefix("rgb(").rstrip(")").split(",")[:3]]
    linear = [value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4 for value in values]
    return float(np.dot([0.2126, 0.7152, 0.0722], linear))


def test_it_is_dark_where_that_is_preferred(page, rows, tmp_path):
    """Page and plots, with contrast; and changes with the preference."""
    contents = explorer_contents(sweep(), rows, ranking=RANKING)
    with beside(page, contents, tmp_path / "explorer.html", color_scheme="dark") as other:
        styles = "[...document.querySelectorAll(place)].map(one => getComputedStyle(one)[name])"

        def of(place, name):
            return [brightness(one) for one in other.evaluate(f"([place, name]) => {styles}", [place, name])]

        backgrounds = of("html, header, thead th, .main-svg:first-child", "backgroundColor")
        texts = of("#now, thead th, .word", "color") + of(".plot .xtick text, .plot .ytick text, .plot .g-ytitle text", "fill")
        assert len(texts) > 20
        assert (min(texts) + 0.05) / (max(backgrounds) + 0.05) > 4.5
        other.emulate_media(color_scheme="light")
        other.wait_for_function("document.getElementById('campbell').layout.paper_bgcolor === '#ffffff'")
        assert min(of("html, .main-svg:first-child", "backgroundColor")) == pytest.approx(1.0)
