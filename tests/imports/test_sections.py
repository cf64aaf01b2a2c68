"""Blades given by section curves: files, edges and sides, cuts at hub and tip, and what is refused."""

import re
import tracemalloc
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from import_defaults import refused
from refusal_tables import pattern_of, refusal_rows
from section_files import CHANNEL, airfoil, csv_text, curve_text, fan, geomturbo_text, sections_of, stacked, turbine
from test_imported_blades import MATERIAL

from r37core.blade.profile import BladeShapeError, area_and_centroid
from r37core.blade.section_changes import SpanLaw
from r37core.config import ConfigError
from r37core.config.remarks import remarks_of_pipeline
from r37core.fem.matrices import assemble
from r37core.fem.mesh_quality import mesh_quality
from r37core.mesh.generate import generate_mesh
from r37core.product.extensions import read_settings
from r37core.rom.reduce import reduce_blade
from r37imports.sections.definition import SectionsDefinition
from r37imports.sections.section_blade import Meridian

ENTRY = {"length_unit": "m", "rotor_axis": [0, 0, 1], "radial": [1, 0, 0], "rotation": "negative", "material": MATERIAL}
SHARES = np.linspace(0.0, 1.0, 9)
TABLE = Path(__file__).with_name("refusals.txt")


def definition_of(curves, **changes):
    return SectionsDefinition("Fan", tuple(tuple(map(tuple, curve.tolist())) for curve in curves), **changes)


@pytest.fixture
def settings_with(config_copy):
    """Settings of a project with a blade Fan, given by a file of this text, and other entries."""
    (config_copy / "sections").mkdir()
    file = config_copy / "config/blades.yaml"
    shipped = file.read_text()

    def read(text, name="fan.csv", others=(), **changes):
        (config_copy / "sections" / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        fan = {"sections": f"sections/{name}", **ENTRY, **changes}
        file.write_text(shipped + yaml.safe_dump({"Fan": fan} | dict(others), sort_keys=False))
        return read_settings(config_copy)

    return read


def test_the_reference_blade_returns_from_its_own_sections(blade, model, steel, boundary, reduction):
    """Its shape and its frequencies."""
    again = definition_of(sections_of(blade)).build(round_edges=True)
    assert again.volume() == pytest.approx(blade.volume(), rel=5e-5)
    for profile, section in zip(blade.profiles, again.sections, strict=True):
        assert section.stagger == pytest.approx(profile.stagger, abs=1e-3)
        for edge, other in ((profile.leading_edge, section.leading_edge), (profile.trailing_edge, section.trailing_edge)):
            assert other.arc is not None and other.radius == pytest.approx(edge.radius, rel=0.02)
    mesh = generate_mesh(again, nodes=2500, layers=1, tip_elements=14)
    found = reduce_blade(mesh, assemble(mesh, steel), steel, boundary, reduction, {}).modes(0.0, 6)[0]
    np.testing.assert_allclose(found, model.modes(0.0, 6)[0], rtol=2e-3)


@pytest.mark.parametrize("trailing", ["round", "blunt", "sharp"])
@pytest.mark.parametrize("make", [fan, turbine])
def test_a_fan_and_a_turbine_have_all_node_sets(make, trailing):
    shape = definition_of(make(trailing=trailing), pressure_forward=make is fan).build(round_edges=True)
    mesh = generate_mesh(shape, nodes=2500, layers=1, tip_elements=14)
    assert mesh_quality(mesh).min() > 0.1
    lines = {name: mesh.points[mesh.node_set(f"tip_{name}")] for name in ("pressure_edge", "camber_line", "suction_edge")}
    assert [len(points) for points in lines.values()] == [29, 15, 29]
    angle = {name: np.arctan2(points[:, 1], points[:, 0])[len(points) // 2] for name, points in lines.items()}
    # the pressure side is towards smaller angles where it looks along the rotation
    ahead = (angle["pressure_edge"], angle["camber_line"], angle["suction_edge"])
    assert list(ahead) == sorted(ahead, reverse=make is turbine)
    assert (shape.sections[-1].trailing_edge.arc is None) == (trailing != "round" or make is fan)
    radius = np.hypot(*mesh.points[mesh.node_set("tip"), :2].T)
    np.testing.assert_allclose(radius, 0.45 if make is fan else 0.36, rtol=1e-9)
    for name in ("root", "leading_edge", "trailing_edge"):
        assert len(mesh.node_set(name)) > 10
    # the normals look from the pressure to the suction side
    around = mesh.points[:, [1, 0, 2]] * [-1.0, 1.0, 0.0]
    assert np.all(np.sum(mesh.normals * around, axis=1) * (1.0 if make is fan else -1.0) > 0.0)


@pytest.mark.parametrize("turn", [lambda curve: curve[::-1], lambda curve: np.roll(curve, 37, axis=0)])
def test_points_may_run_either_way_and_start_anywhere(turn):
    for make in (fan, turbine):
        curves = make()
        shapes = [definition_of(several).build(round_edges=True) for several in (curves, [turn(curve) for curve in curves])]
        places = [shape.position(SHARES, SHARES, np.linspace(-1.0, 1.0, 9)) for shape in shapes]
        np.testing.assert_allclose(*places, atol=1e-6)


@pytest.mark.parametrize(("trailing", "accuracy"), [("sharp", 5e-4), ("blunt", 5e-3)])
def test_thin_staggered_tips_keep_their_sides(trailing, accuracy):
    """Of an oblique trailing edge: the middles of both sides, by their own lengths, lie the other way round."""
    outline = airfoil(thickness=0.02, camber=0.1, trailing=trailing)[8:]
    curves = stacked(outline, np.linspace(0.25, 0.28, 3), np.full(3, 0.055), np.radians([55.0, 57.0, 59.0]))
    area = 0.055**2 * abs(area_and_centroid(*outline.T)[0])
    assert definition_of(curves).build(round_edges=True).volume() == pytest.approx(0.03 * area, rel=accuracy)


def test_the_cost_of_a_section_rises_with_its_points():
    """A section of 20,000 points: compared in pairs they take half a minute and 3 GB."""
    section = definition_of([fan(count=10_001)[0]])
    tracemalloc.start()
    assert section.curve(0).stagger == pytest.approx(np.radians(20.0), abs=0.01)
    assert tracemalloc.get_traced_memory()[1] < 1e8
    tracemalloc.stop()


def test_few_points_suffice():
    dense, coarse = (definition_of(turbine(count=count)).build(round_edges=True) for count in (120, 16))
    assert coarse.volume() == pytest.approx(dense.volume(), rel=2e-3)


def test_a_blade_of_nine_sections_of_two_sides_of_112_points(settings_with):
    """The form of an open set of variants of rotor 37: sides apart, 224 points a section."""
    rows = ["section,side,x,y,z"]
    for number, curve in enumerate(fan(count=113)):
        half = len(curve) // 2
        for side, points in ((0, curve[: half + 1]), (1, np.concatenate([curve[half:], curve[:1]])[::-1])):
            for place in np.linspace(0, len(points) - 1, 112).round().astype(int):
                rows.append(f"{number},{side}," + ",".join(f"{value:.9f}" for value in points[place]))
    definition = settings_with("\n".join(rows)).blades["Fan"].definition
    assert len(definition.sections) == 9 and {len(section) for section in definition.sections} == {222}
    assert definition.build(round_edges=True).volume() == pytest.approx(
        definition_of(fan(count=113)).build(round_edges=True).volume(), rel=1e-3
    )


def test_all_files_give_one_blade(settings_with, config_copy):
    """From tip to hub, in millimetres, in other axes and mirrored, too."""
    curves = fan()
    turned = [curve[:, [2, 1, 0]] for curve in curves][::-1]
    files = {
        "fan.curve": (curve_text(curves), {}),
        "fan.geomTurbo": (geomturbo_text(curves), {}),
        "polar.geomTurbo": (geomturbo_text(curves, "ZRTH"), {}),
        "turned.csv": (
            csv_text(turned, 1e3, 6),
            {"length_unit": "mm", "rotor_axis": [1, 0, 0], "radial": [0, 0, 1], "rotation": "positive"},
        ),
    }
    folder, others = config_copy / "sections", {}
    for name, (text, changes) in files.items():
        (folder / name).write_text(text)
        others[name.replace(".", "-")] = {"sections": f"sections/{name}", **ENTRY, **changes}
    blades = settings_with(csv_text(curves), others=others).blades
    expected = blades["Fan"].definition.build(round_edges=True).position(SHARES, SHARES, np.zeros(9))
    for name in others:
        shape = blades[name].definition.build(round_edges=True)
        np.testing.assert_allclose(shape.position(SHARES, SHARES, np.zeros(9)), expected, atol=1e-6, err_msg=name)


def test_hub_and_tip_are_cut(settings_with, config_copy):
    """By radii, by cones, by curves next to the file, by the channel of a file."""
    meridian = "\n".join(f"0 {radius} {z}" for z, radius in ((-0.5, 0.445), (-0.3, 0.445), (0.3, 0.435), (0.5, 0.435)))
    (config_copy / "sections/shroud.curve").write_text(f"# shroud\n{meridian}\n")
    (config_copy / "sections/fan.geomTurbo").write_text(geomturbo_text(fan(), channel=CHANNEL))
    (config_copy / "sections/fan.csv").write_text(csv_text(fan()))
    cone = {"hub": {"radius_m": 0.16}, "tip": {"cone_zr_m": [[-0.1, 0.44], [0.1, 0.43]]}}
    others = {
        "Cone": {"sections": "sections/fan.csv", **ENTRY, **cone},
        "Channel": {"sections": "sections/fan.geomTurbo", **ENTRY},
        "Whole": {"sections": "sections/profile.curve", **ENTRY, "tip": "sections"},
        "Named": {"sections": "sections/fan.csv", **ENTRY, "tip": "sections/shroud.curve"},
    }
    blades = settings_with(curve_text(fan()), "profile.curve", others).blades
    shapes = {name: blades[name].definition.build(round_edges=True) for name in ("Fan", *others)}

    ends = {"Cone": (0.16, 0.435, -0.05), "Channel": (0.16, 0.445, -0.01), "Whole": (0.15, 0.45, 0.0)}
    for name, (hub, tip, slope) in (ends | dict.fromkeys(("Fan", "Named"), (0.15, 0.44, -1.0 / 60.0))).items():
        for span, radius, rise in ((0.0, hub, 0.0), (1.0, tip, slope)):
            x, y, z = shapes[name].position(SHARES, np.full(9, span), np.linspace(-1.0, 1.0, 9)).T
            np.testing.assert_allclose(np.hypot(x, y), radius + rise * z, rtol=1e-8, err_msg=name)


INF = """!======  CFX-BladeGen Export  ========
Axis of Rotation: Z
Number of Blade Sets: 1
Geometry Units: MM
Hub Data File: inner.curve
Shroud Data File: outer.curve
Profile Data File: R1_Blade.crv
"""
MERIDIANS = ("inner.curve", "outer.curve")


@pytest.mark.parametrize(
    ("inf", "meridians"),
    [
        ("", ("hub.crv", "shroud.crv")),
        ("", ("R1_hub.curve", "shroud_2.crv")),
        ("", ("Rot_Hub.curve", "Rot_Shd.curve")),
        (INF, MERIDIANS),
        (INF.replace("inner", r"C:\a\inner").replace("outer", "../a/outer").replace("R1", "a/R1"), MERIDIANS),
    ],
)
def test_meridians_of_turbogrid_cut_the_blade(settings_with, config_copy, inf, meridians):
    folder = config_copy / "sections"
    (folder / "BladeGen.inf").write_text(inf)
    for name, radius in zip(meridians, (160, 440), strict=True):
        (folder / name).write_text(f"{radius} 0 -300\n{radius} 0 300\n")
    text = curve_text(fan(), 1e3)
    settings = settings_with(text, "R1_Blade.crv", length_unit="mm")
    assert settings.blades["Fan"].definition.hub == ((-0.3, 0.16), (0.3, 0.16))
    (remark,) = (line for line in remarks_of_pipeline(settings) if line.startswith("Fan: sections"))
    assert remark.endswith(" to 0.45 m, the blade from 0.16 to 0.44 m: the hub cuts off 10 mm, the tip cuts off 10 mm")
    with refused(rf"hub: leave out, for sections/{meridians[0]}; tip: leave out, for sections/", ConfigError):
        settings_with(text, "R1_Blade.crv", length_unit="mm", hub="?", tip="?")


@pytest.mark.parametrize(("kind", "changes", "message"), refusal_rows(TABLE, "next to an .inf in millimetres"))
def test_the_inf_of_turbogrid_is_not_contradicted(settings_with, config_copy, kind, changes, message):
    (config_copy / "sections/BladeGen.inf").write_text(INF)
    with refused(pattern_of(message), ConfigError):
        settings_with(curve_text(fan(), 1e3), "R1_Blade.crv", **yaml.safe_load(changes))


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (("hub.curve", "outer.curve"), r"tip: found hub\.curve next to the sections, and outer\.curve; give tip: one of them"),
        (("A_hub.crv", "B_hub.crv"), r"hub: found A_hub\.crv, B_hub\.crv next to the sections; give hub: one of them"),
    ],
)
def test_which_of_two_files_is_a_meridian_is_a_question(settings_with, config_copy, names, message):
    for name in names:
        (config_copy / "sections" / name).write_text("160 0 -300\n160 0 300\n")
    with refused(rf"Fan\.{message}", ConfigError):
        settings_with(curve_text(fan(), 1e3), "R1_Blade.crv", length_unit="mm")


def test_the_unit_of_a_file_is_that_of_the_entry(settings_with):
    whole = geomturbo_text([1e3 * curve for curve in fan()])
    text = whole.replace("units 1", "units 0.001")
    asked = {"length_unit": "?", "rotation": "positive"}
    expected = settings_with(whole, "fan.geomTurbo", length_unit="mm").blades["Fan"].definition
    assert settings_with(text, "fan.geomTurbo", length_unit="mm").blades["Fan"].definition.hub == expected.hub
    with refused("length_unit: mm; by the radii", ConfigError):
        settings_with(text, "fan.geomTurbo", **asked)
    with refused(r"length_unit: found m, and mm in the .inf next to the sections, or in their file", ConfigError):
        settings_with(text, "fan.geomTurbo", length_unit="m")


def test_a_meridian_has_one_radius_at_every_z(settings_with, config_copy):
    """Next to the blade: ducts may run back."""
    duct = [(0.5, 0.3), (0.2, 0.16), (0.0, 0.16), (-0.2, 0.16), (-0.15, 0.1)]
    (config_copy / "sections/hub.curve").write_text("".join(f"{r} 0 {z}\n" for z, r in duct))
    shape = settings_with(FAN, hub="sections/hub.curve").blades["Fan"].definition.build(round_edges=True)
    points = shape.position(SHARES, np.zeros(9), np.zeros(9))
    np.testing.assert_allclose(np.hypot(points[:, 0], points[:, 1]), 0.16, rtol=1e-9)
    back = tuple((z, 0.16 + z) for z in (-0.2, 0.01, 0.0, 0.2))
    with pytest.raises(BladeShapeError, match="blade Fan: the meridian runs back in z near z = "):
        definition_of(fan(), hub=back).build(round_edges=True)


@pytest.mark.parametrize("order", [1, -1])
def test_a_meridian_goes_through_its_points_and_straight_on(order):
    z = np.linspace(0.0, 0.04, 5)
    meridian = Meridian(np.stack([z, 0.2 + 10.0 * z**2], axis=1)[::order])
    assert meridian.radius(z) == pytest.approx(0.2 + 10.0 * z**2, rel=1e-12)
    for end, step in ((z[0], -0.01), (z[-1], 0.01)):
        assert meridian.radius(end + step) == pytest.approx(meridian.radius(end) + step * meridian.slope(end), rel=1e-12)
        assert meridian.slope(end + step) == meridian.slope(end)
    assert Meridian([(0.0, 0.2), (0.04, 0.22)][::order]).radius(z) == pytest.approx(0.2 + 0.5 * z, rel=1e-12)


def test_stagger_sweep_and_lean_on_top(settings_with):
    rows = [{"span_percent": span, "sweep_cm": 0.01 * span, "lean_deg": 0.02 * span} for span in (0, 100)]
    family = {"base": "Fan", "vary": {"stagger_deg": [0, 3]}}
    others = {"Swept": {"base": "Fan", "sweep_lean": rows}, "Part": {"base": "Swept", "sweep_percent": 50, "lean_percent": 200}}
    others |= {"Family": family, "Chordwise": {"base": "Fan", "chordwise_sweep_deg": 10}}
    others["Own"] = {"sections": "sections/fan.csv", **ENTRY, "vary": {"stagger_deg": [0, 3], "material.density_kg_m3": [4430]}}
    blades = settings_with(csv_text(fan()), others=others).blades
    assert blades["Own_3_4430"].definition.sections == blades["Family_3"].definition.sections
    assert blades["Family_0"].definition.sections == blades["Fan"].definition.sections
    curves = [blades[name].definition.curves for name in ("Fan", "Family_3")]
    for before, after in zip(*curves, strict=True):
        assert after.stagger - before.stagger == pytest.approx(np.radians(3.0), abs=1e-5)
        assert (after.radius, after.z, after.centroid[1]) == pytest.approx(
            (before.radius, before.z, before.centroid[1]), abs=1e-5
        )
    tips = {}
    for name in ("Fan", "Swept", "Part", "Chordwise"):
        points = blades[name].definition.build(round_edges=True).position(SHARES, np.ones(9), np.zeros(9))
        tips[name] = np.stack([np.arctan2(points[:, 1], points[:, 0]), points[:, 2]])
    np.testing.assert_allclose(tips["Swept"] - tips["Fan"], np.outer([-np.radians(2.0), 0.01], np.ones(9)), atol=1e-9)
    np.testing.assert_allclose(tips["Part"] - tips["Fan"], np.outer([-np.radians(4.0), 0.005], np.ones(9)), atol=1e-9)
    assert np.all(tips["Chordwise"][1] < tips["Fan"][1])


def test_a_law_over_the_span_turns_each_section_by_its_own_angle():
    definition = definition_of(fan())
    turned = definition.changed({"stagger": SpanLaw.linear(0.0, 0.1)})
    angles = [after.stagger - before.stagger for before, after in zip(definition.curves, turned.curves, strict=True)]
    np.testing.assert_allclose(angles, np.linspace(0.0, 0.1, 9), atol=1e-5)
    assert turned.sections[0] == definition.sections[0]


def section_without_trailing_edge():
    angle = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    return [np.stack([np.full(40, radius), 0.02 * np.sin(angle), 0.02 * np.cos(angle)], axis=1) for radius in (0.2, 0.25, 0.3)]


def with_points(places, others):
    """The fan with some points of its fourth section where others are."""
    curves = fan()
    curves[3][places] = curves[3][others]
    return csv_text(curves)


def three_sides():
    """The fan with a column of three sides."""
    header, *rows = FAN.splitlines()
    return "\n".join([f"{header},side", *(f"{row},{number % 3}" for number, row in enumerate(rows))])


def changed_section(change, number=3, count=9):
    """The fan's first sections, as many as `count`, with one changed."""
    curves = fan()[:count]
    return csv_text([*curves[:number], change(curves[number]), *curves[number + 1 :]])


def twisted(curve, degrees):
    """The section turned about the radial line through its middle."""
    y, z = (curve - curve.mean(axis=0)).T[1:]
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return curve.mean(axis=0) + np.stack(
        [curve[:, 0] - curve[:, 0].mean(), y * cosine - z * sine, y * sine + z * cosine], axis=1
    )


def with_outlier(curve, axis):
    """The section with its 31st point 5 mm off."""
    return np.where((np.arange(len(curve)) == 30)[:, None] & (np.arange(3) == axis), curve + 0.005, curve)


FAN = csv_text(fan())
CURVE = curve_text(fan())
TURBO = geomturbo_text(fan())
TEXTS = {"fan.csv": FAN, "fan.curve": CURVE, "fan.geomTurbo": TURBO}
CHANNELS = geomturbo_text(fan(), channel=CHANNEL)


def with_line(text, number, line):
    """The text with another line of this number, from 1."""
    lines = text.splitlines()
    lines[number - 1] = line
    return "\n".join(lines) + "\n"


def broken_row(change):
    """Mutation of a file in a line of coordinates, in the middle of a section."""

    def changed(text):
        lines = text.splitlines()
        number = next(number for number in range(len(lines) // 2, len(lines)) if lines[number - 1].count("0.") == 3)
        return with_line(text, number + 1, change(lines[number]))

    return changed


def first_number(value):
    """Change of a line's first coordinate."""
    return lambda line: re.sub(r"-?\d\.\d+", value, line, count=1)


MUTATIONS = {
    "nan": broken_row(first_number("nan")),
    "infinite": broken_row(first_number("1e999")),
    "huge": broken_row(first_number("1e308")),
    "superscript": broken_row(first_number("\u00b2")),
    "comma": broken_row(first_number("0,1")),
    "word": broken_row(lambda line: "end of the section"),
    "missing number": broken_row(lambda line: re.sub(r"[\s,]*-?\d\.\d+$", "", line)),
    "zero bytes": broken_row(lambda line: "\0" * 40),
    "one point far off": broken_row(first_number("9.0")),
    "truncated": lambda text: text[: int(0.53 * len(text))],
    "no digits": lambda text: re.sub(r"\d", "", text),
    "empty": lambda text: "",
    "blank": lambda text: " \n" * 100,
    "one line": lambda text: text.replace("\n", " "),
    "latin-1": lambda text: (text + "# Schaufel f\u00fcr \u00c5").encode("latin-1"),
    "utf-16": lambda text: text.encode("utf-16"),
}
ALIKE = {
    "crlf": lambda text: text.replace("\n", "\r\n"),
    "byte order mark": lambda text: "\ufeff" + text,
    "units of IGG": lambda text: text.replace("units 1", "UNITS-FACTOR 1"),
    "exponents": lambda text: re.sub(r"(?m)(-?\d\.\d+)(?=\s*$)", r"\1D+00", text),
}


@pytest.mark.parametrize("name", TEXTS)
@pytest.mark.parametrize("mutation", MUTATIONS)
def test_no_broken_file_ends_in_an_inner_error(settings_with, name, mutation):
    with refused(rf"{re.escape(name)}|Fan\.\w+: ", ConfigError) as refusal:
        settings_with(MUTATIONS[mutation](TEXTS[name]), name)
    assert len(str(refusal.value).splitlines()) == 1 and len(str(refusal.value)) < 600


@pytest.mark.parametrize("name", TEXTS)
@pytest.mark.parametrize("mutation", ALIKE)
def test_another_form_of_a_file_is_the_same_blade(settings_with, name, mutation):
    text = TEXTS[name]
    expected, found = (settings_with(form, name).blades["Fan"].definition for form in (text, ALIKE[mutation](text)))
    assert found == expected


@pytest.mark.parametrize(("name", "change", "message"), refusal_rows(TABLE, *TEXTS, "channel.geomTurbo"))
def test_a_line_that_is_wrong_is_named(settings_with, name, change, message):
    text, (old, _, new) = {**TEXTS, "channel.geomTurbo": CHANNELS}[name], change.partition(" -> ")
    number, _, line = change.partition(": ")
    with refused(pattern_of(message), ConfigError) as refusal:
        settings_with(text.replace(old, new, 1) if new else with_line(text, int(number), line), name)
    assert len(str(refusal.value).splitlines()) == 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", r"sections/fan\.csv:1: blade Fan: the table lacks the columns section, x, y, z"),
        ("section,x,y,z\n", r"fan\.csv:1: blade Fan: found no rows"),
        (csv_text(fan()[:1]), r"fan\.csv:2: .*found 1 section; allowed: at least 2, from hub to tip"),
        (csv_text([curve[::20] for curve in fan()]), r"fan\.csv:2: .*found a section of 6 points; allowed: at lea"),
        (with_points([20, 40], [40, 20]), r"\.csv:\d+: .*: section 4 of 9 from the hub: the curve crosses itself"),
        (with_points([30, 31], [31, 30]), r"crosses itself, between points 30 and 31 and points 32 and 33"),
        (three_sides(), r"\.csv:2: .*found 3 values in the column side of one section; allowed: one or two"),
        (csv_text(section_without_trailing_edge()), r"fan\.csv:2: .*found no \w+ edge: the curve is as thick"),
        (csv_text([*fan()[:3], *fan()[2:5]]), r"fan\.csv: blade Fan: section 4 of 6 .*does not lie wholly above"),
        (FAN + "0.1\n" * 10**6, r"fan\.csv:1: .*found 1\d{6} lines; allowed: at most 200000 points"),
        (csv_text(fan(), 1e3), r"Fan\.length_unit: the blade would be .*fitting units: mm"),
    ],
)
def test_a_broken_table_is_one_line(settings_with, text, message):
    with refused(message, ConfigError) as refusal:
        settings_with(text)
    assert len(str(refusal.value).splitlines()) == 1


def test_files_of_other_kinds(settings_with):
    for name, text, message in (
        ("fan.curve", "# nothing\n", r"fan\.curve:1: blade Fan: found no points"),
        ("fan.dat", FAN, r"fan\.dat: blade Fan: found a file of kind '\.dat'; allowed: \.curve, \.crv, \.geomTurbo, \.csv"),
        (
            "fan.geomTurbo",
            TURBO + TURBO,
            r"fan\.geomTurbo:\d+: .*found 2 blades, with suction sides in lines 6, \d+; allowed: one",
        ),
    ):
        with refused(message, ConfigError):
            settings_with(text, name)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda curve: np.add(curve, [0.0, 0.0, 0.05]), r"axial place \+50 mm"),
        (lambda curve: curve * [-1.0, -1.0, 1.0], "place round the axis -8"),
        (lambda curve: twisted(curve, 10.0), r"stagger -9\.\d+ degrees off"),
        (lambda curve: curve * [1.0, 1.3, 1.3], r"length \+3\d\.\d mm off"),
        (lambda curve: np.delete(curve, slice(15, 30), axis=0), r"gap of \d+\.?\d* mm after po"),
        (lambda curve: with_outlier(curve, 2), "inward corner of .* at point"),
        (lambda curve: with_outlier(curve, 0), "radius 5 mm off .* at point 31 of"),
    ],
)
def test_a_section_that_no_blade_has_is_named(settings_with, change, message):
    with refused(rf"fan\.csv:356: .*section 4 of 9 .*{message}", ConfigError):
        settings_with(changed_section(change))


def test_of_five_sections_one_out_of_line_is_named(settings_with):
    with refused(r"\.csv:238: .*section 3 of 5 .*axial place \+50 mm", ConfigError):
        settings_with(changed_section(lambda curve: np.add(curve, [0.0, 0.0, 0.05]), 2, 5))


@pytest.mark.parametrize(("kind", "changes", "message"), refusal_rows(TABLE, "sections"))
def test_an_entry_is_refused_with_what_fits(settings_with, kind, changes, message):
    with refused(pattern_of(message), ConfigError) as refusal:
        settings_with(FAN, **yaml.safe_load(changes))
    assert len(str(refusal.value).splitlines()) == 1


def test_a_flat_last_section_needs_a_tip(settings_with):
    """Sections by planes: the casing cuts the blade."""
    radii = np.linspace(0.15, 0.45, 9)
    flat = [curve * [0.0, 1.0, 1.0] + [radius, 0.0, 0.0] for curve, radius in zip(fan(), radii, strict=True)]
    with refused(r"tip: the last section lies up to .* mm off every surface.*with tip: \{ cone_zr_m", ConfigError):
        settings_with(csv_text(flat))


@pytest.mark.parametrize("turn", [[0, 1, 2], [2, 0, 1]])
def test_only_sections_on_surfaces_about_another_axis_refuse_the_axis(settings_with, turn):
    """A turn that the file and its directions share changes nothing, and sections by planes tell no axis."""
    axis, radial = np.eye(3, dtype=int)[turn].T[2].tolist(), np.eye(3, dtype=int)[turn].T[0].tolist()
    steep = stacked(
        airfoil(thickness=0.05, camber=0.25), np.linspace(0.15, 0.45, 9), np.full(9, 0.12), np.full(9, np.radians(70.0))
    )
    flat = [np.stack([np.full(len(curve), curve[:, 0].max()), *curve.T[1:]], axis=1) for curve in steep]
    for curves, ends in ((fan(), {}), (flat, {"tip": {"radius_m": 0.44}})):
        text = csv_text([curve[:, turn] for curve in curves])
        assert settings_with(text, rotor_axis=axis, radial=radial, **ends).blades["Fan"].has_profiles


@pytest.mark.parametrize("key", ["hub", "tip"])
def test_a_cone_that_fits_the_reversed_axis_says_so(settings_with, key):
    text = csv_text([np.add(curve, [0.0, 0.0, 0.2]) for curve in fan()])
    radii = {"hub": (0.08, 0.16), "tip": (0.52, 0.44)}[key]
    cone = {key: {"cone_zr_m": [[0.0, radii[0]], [0.2, radii[1]]]}}
    assert settings_with(text, **cone).blades["Fan"].has_profiles
    message = rf"Fan\.rotor_axis: {key}: its radius .* the sections.*, or rotor_axis: \[0.0, 0.0, 1.0\], with which it fits"
    with refused(message, ConfigError):
        settings_with(text, rotor_axis=[0, 0, -1], **cone)


def test_designs_of_sections_vary_what_sections_have(settings_with):
    hub = {"cone_zr_m": [[-0.1, 0.16], [0.1, 0.16]]}
    vary = {"stagger_deg.tip": [1.0], "length_unit": [1.01], "tip.radius_m": [0.44], "material.density_kg_m3": [4500.0]}
    definition = settings_with(FAN, hub=hub, vary=vary).blades["Fan_1_1p01_0p44_4500"].definition
    assert definition.tip == ((0.0, 0.44),) and definition.curve(0).radius == pytest.approx(0.1515, rel=1e-3)


def test_sense_check_false_takes_it_as_it_is(settings_with):
    assert settings_with(FAN, rotor_axis=[0, 1, 0], tip={"radius_m": 0.4}, sense_check=False).blades["Fan"].has_profiles
    assert settings_with(FAN, rotation="positive", sense_check=False).blades["Fan"].has_profiles
    odd = changed_section(lambda curve: np.delete(np.add(curve, [0.0, 0.0, 0.02]), slice(15, 30), axis=0))
    assert settings_with(odd, "odd.csv", sense_check=False).blades["Fan"].has_profiles


@pytest.mark.parametrize("radius", [0.02, 0.03, 0.045])
def test_the_edges_of_a_plate_begin_where_their_circles_do(radius):
    """With semicircular ends, on a chord of 0.1 m along the axis: as deep below the nose as the circle's radius."""
    angle = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 41)
    end = np.stack([1.0 - radius + radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    straight = np.stack([np.linspace(1.0 - radius, radius, 42)[1:-1], np.full(40, radius)], axis=1)
    half = np.concatenate([end, straight])
    outline = np.concatenate([half, [1.0, 0.0] - half])
    section = definition_of(stacked(outline, [0.3], [0.1], [0.0])).curve(0)
    for edge, nose in ((section.leading_edge, -0.05), (section.trailing_edge, 0.05)):
        assert edge.radius == pytest.approx(0.1 * radius, rel=1e-3)
        np.testing.assert_allclose(np.abs(edge.corners[:, 2] - nose), 0.1 * radius, rtol=1e-2)


def test_an_edge_that_bends_between_two_corners_is_round():
    """A plate whose leading edge turns by 72, 36 and 72 degrees at its three points."""
    angle, height = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 41), 0.03
    trailing = np.stack([1.0 - height + height * np.cos(angle), height * np.sin(angle)], axis=1)
    side = np.stack([np.linspace(1.0 - height, 0.02, 42)[1:-1], np.full(40, height)], axis=1)
    leading = [[0.02, height], [0.02 - height / np.tan(np.radians(72.0)), 0.0], [0.02, -height]]
    outline = np.concatenate([trailing, side, leading, side[::-1] * [1.0, -1.0]])
    section = definition_of(stacked(outline, [0.3], [0.1], [0.0])).curve(0)
    assert section.leading_edge.arc is not None and section.trailing_edge.arc is not None


def test_blunt_edges_are_cut_between_the_corners():
    definition = definition_of(fan())
    volumes = [definition.build(round_edges=is_round).volume() for is_round in (True, False)]
    assert 0.99 * volumes[0] < volumes[1] < volumes[0]
    assert replace(definition, name="Other") != definition
