"""Panels of the studies in the explorer."""

from pathlib import Path

import pandas as pd
from explorer_cases import beside
from test_explorer import datasets, page  # noqa: F401

import r37studies
from r37core.explorer import page_parts
from r37core.explorer.contents import explorer_contents
from r37studies.designs.maps import contents as design_panel

STUDIES = Path(r37studies.__file__).parent


def judged(*verdicts):
    """Panel of the requirements with rows: blade, scene, verdict on the length above yield, of which 24 rad/s are allowed."""
    names = ("blade", "scene", "verdict")
    numbers = {"requirement": "above_yield", "limit": 24.0, "value": 1.0, "margin": 1.0, "unit": "rad/s"}
    numbers |= {"certainty": "", "note": "", "from_rad_s": None, "to_rad_s": None}
    rows = [dict(zip(names, row, strict=True)) | numbers for row in verdicts]
    return {"requirements": {"pairs": [], "requirements": rows}}


def test_the_map_of_designs_has_the_line_of_a_requirement(page, datasets, tmp_path):
    """Round the design that does not fail it, which has a mark; a step in speed leaves the line where it is."""
    keys = ["scene.casing.clearance_m", "scene.lining.thickness_m"]
    places = [(clearance, thickness) for clearance in (3e-4, 6e-4) for thickness in (0.001, 0.002)]
    designs = pd.DataFrame([("Ref", f"Room_{number}", "Room", *place) for number, place in enumerate(places)])
    table = designs.set_axis(["blade", "scene", "family", *keys], axis=1).assign(
        length_dangerous_rad_s=[40.0, 30, 20, 0], length_unknown_rad_s=[0.0, 0, 0, 15]
    )
    verdicts = [("Ref", f"Room_{number}", verdict) for number, verdict in enumerate(("fails", "fails", "fails", "meets"))]
    contents = explorer_contents(datasets) | {"panels": {"designs": design_panel(table)} | judged(*verdicts)}
    parts = page_parts([STUDIES / f"{name}/panel.js" for name in ("designs", "requirements")])
    with beside(page, contents, tmp_path / "explorer.html", place="#blade=Ref&scene=abradable&speed=900", parts=parts) as other:
        map_ = "document.getElementById('designs')"
        sides = f"{map_}.layout.shapes.map(one => [one.x0, one.y0, one.x1, one.y1])"
        assert sorted(other.evaluate(sides)) == [[0.5, 0.5, 0.5, 1.5], [0.5, 0.5, 1.5, 0.5]]
        assert other.evaluate(f"{map_}.data[0].text") == [["40", "20"], ["30", "0 to 15 \u2713"]]
        assert "limit of above yield" in other.text_content("#designs .legend")
        other.locator("h1").click()
        other.keyboard.press("ArrowRight")
        assert "1000.3 rad/s" in other.text_content("#now")
        assert [0.5, 0.5, 0.5, 1.5] in other.evaluate(sides)


def test_the_reason_of_a_verdict_stands_on_a_phone(page, datasets, tmp_path):
    panel = judged(("Ref", "abradable", "fails"))
    panel["requirements"]["pairs"] = [{"blade": "Ref", "scene": "abradable", "verdict": "fails", "reason": "too long " * 12}]
    contents = explorer_contents(datasets) | {"panels": panel}
    parts = page_parts([STUDIES / "requirements/panel.js"])
    with beside(page, contents, tmp_path / "explorer.html", (390, 844), parts=parts) as other:
        reason = other.locator("#verdict td:last-child").bounding_box()
        assert reason["x"] + reason["width"] <= 390
        other.locator("#verdict button").click()
        assert other.locator("#verdict tr.chosen").count() == 1
