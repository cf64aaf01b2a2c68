"""Figures: captions, sizes that print as they are, one colour per blade everywhere, and what the new ones show."""

import os
import re
import subprocess
import sys
from functools import partial

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from matplotlib.collections import PathCollection, PolyCollection
from matplotlib.colors import to_hex
from matplotlib.markers import MarkerStyle
from matplotlib.text import Text
from PIL import Image

from r37core.figures import campbell_diagram, comparison, interaction_map, maps, response_curves, style
from r37core.product.targets import FIGURES
from r37core.results.columns import INTERACTIONS, names
from r37core.results.events import Danger
from r37core.results.table_file import read_table
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import RunStatus

BLADES, SCENES = ["Ref", "L50", "S100"], ["abradable", "direct"]
SPEEDS = np.arange(750.0, 2000.1, 25.0)


draw_comparison = partial(comparison.draw_comparison, below=0.02, above=0.06)


@pytest.fixture(scope="module")
def datasets():
    """Three blades whose 1B meets engine order 4 at 1672, 1621 and 1635 rad/s, with a peak 2% above; one run diverged."""
    crossings = np.array([1672.0, 1621.0, 1635.0])
    speeds, orders = np.linspace(0.0, 2000.0, 21), np.arange(1, 9)
    rising = np.sqrt(1.0 + (speeds / 3000.0) ** 2)
    frequency = np.array([[scale * rest * rising for rest in (840.0, 2510.0, 3030.0)] for scale in crossings / 1672.0])
    crossing = np.full((3, 3, 8), np.nan)
    crossing[:, 0, 3], crossing[:2, 0, 4] = crossings, crossings[:2] - 400.0
    clearance = 0.2 * np.linspace(-0.01, 0.01, 5)
    about = {
        "frequency": (("blade", "mode", "speed"), frequency),
        "crossing_speed": (("blade", "mode", "engine_order"), crossing),
        "dynamic_clearance": (("blade", "mode", "tangential_displacement"), np.broadcast_to(clearance, (3, 3, 5))),
    }
    axes = {"blade": BLADES, "mode": ["1B", "1T", "2B"], "speed": speeds, "engine_order": orders}
    campbell = xr.Dataset(about, axes | {"tangential_displacement": np.linspace(-0.01, 0.01, 5)})
    peak = 1e-3 / (1.0 + ((SPEEDS - 1.02 * crossings[:, None]) / 20.0) ** 2)
    status = np.zeros((3, 2, len(SPEEDS)), dtype="i1")
    status[1, 1, 3] = RunStatus.DIVERGED
    values = np.where(status > 0, np.nan, peak[:, None, :] * np.array([1.0, 0.5])[:, None])
    dims, coords = ("blade", "scene", "speed"), {"blade": BLADES, "scene": SCENES, "speed": SPEEDS}
    both = {name: ((*dims, "tip_point"), np.repeat(values[..., None], 2, axis=-1)) for name in ("rms_normal", "rms_tangential")}
    # beyond a limit in revolution 30 where the motion is large, on bare casings at all speeds
    left = np.where((values > 0.7e-3) | (np.arange(2) > 0)[:, None], 30.0, np.nan)
    both |= {"status": (dims, status), "exit_revolution": (dims, left), "exit_cause": (dims, (2 * (left > 0.0)).astype("i1"))}
    rms = xr.Dataset(both, coords | {"tip_point": ["leading_edge", "trailing_edge"]})
    stresses = {f"max_von_mises_{name}": (dims, factor * 1e12 * values) for name, factor in (("inside", 1.6), ("ever", 2.0))}
    danger = np.where(stresses["max_von_mises_inside"][1] > 1.38e9, Danger.DANGEROUS, np.where(left > 0.0, Danger.UNKNOWN, 0))
    stresses |= {"yield_danger": (dims, danger.astype("i1")), "share_of_revolutions_above_yield": (dims, 600.0 * values)}
    stresses |= {"yield_stress": (dims[:2], np.full((3, 2), 1.38e9)), "stress_region": (dims[:2], np.full((3, 2), "airfoil"))}
    stress = xr.Dataset(stresses, coords, {"contact": "11 patches: Ref, L50, S100"})
    order = np.arange(0.0, 20.001, 0.01)
    spectrum = values[..., None] * np.exp(-(((order - 4.0) / 0.02) ** 2)) + 1e-9
    spectra = {name: ((*dims, "engine_order"), spectrum) for name in ("amplitude", "amplitude_tangential")}
    angle = np.linspace(0.0, 2 * np.pi, 30)
    wear = {"wear": ((*dims, "angle"), np.repeat(values[..., None], 30, axis=-1))}
    wear["worn_through_share"] = (dims, np.where(values > 0.9 * np.nanmax(values), 0.1, 0.0 * values))
    return {
        "campbell": campbell,
        "rms": rms,
        "stress": stress,
        "spectrum": xr.Dataset(spectra, coords | {"engine_order": order}),
        "wear": xr.Dataset(wear, coords | {"angle": angle}),
    }


def response(datasets, blade="Ref", **changes):
    """Figure of the response of a blade, with changes of the stress."""
    of = {kind: datasets[kind].sel(blade=blade) for kind in ("campbell", "rms", "stress")}
    return response_curves.draw_response(blade, **of | {"stress": of["stress"].assign_attrs(changes)})


def compared(datasets, **changes):
    """Figure of all blades in abradable contact, with changes of the stress."""
    rms, stress = (datasets[kind].sel(scene="abradable") for kind in ("rms", "stress"))
    return draw_comparison(datasets["campbell"], rms, stress.assign(changes), "abradable")


def interactions(*rows):
    """summary.csv of rows of 1B/4 that differ from one, at 1700 rad/s with 20 rad/s above yield, in what is given."""
    row = {"blade": "Ref", "scene": "abradable", "mode": "1B", "engine_order": 4, "peak_speed_rad_s": 1700.0}
    row |= {"length_dangerous_rad_s": 20.0, "length_unknown_rad_s": 0.0, "largest_stress_over_yield": 4.5}
    row |= {"peak_motion_m": 0.01, "status": "completed"}
    columns = dict.fromkeys([*names(INTERACTIONS), *row])
    return pd.DataFrame([row | given for given in rows], columns=list(columns)).astype({"engine_order": "Int64"})


def draw_interactions(datasets, *rows):
    table = interactions(*rows or ({}, {"blade": "L50", "scene": "direct"}))
    return interaction_map.draw_interactions(datasets["campbell"], datasets["rms"], table, datasets["stress"])


def scenes_of(figure):
    """Panels of the scenes of a figure of the interactions, without the rows of the blades below each."""
    return [axes for axes in figure.axes[::2] if axes.get_ylabel() == "frequency (Hz)"]


def texts(of):
    return [text.get_text() for text in of]


def marks(axes):
    """Marks of one kind each, those without any left out."""
    return [one for one in axes.collections if isinstance(one, PathCollection) and len(one.get_offsets())]


def circles(axes):
    """Speed, frequency and area of each circle."""
    places = [(one.get_offsets(), one.get_sizes()) for one in marks(axes)]
    return [row for offsets, sizes in places for row in np.column_stack([offsets, np.resize(sizes, len(offsets))])]


@pytest.fixture(scope="module")
def drawn(datasets):
    """Every figure of the sweep, by name."""
    return {
        "campbell": campbell_diagram.draw_campbell(datasets["campbell"].sel(blade="Ref"), "Ref"),
        "interactions": draw_interactions(datasets),
        "response": response(datasets),
        "spectrum": map_of(datasets, "spectrum", maps.draw_spectral_map)[0],
        "wear": map_of(datasets, "wear", maps.draw_wear_map)[0],
        "comparison": compared(datasets),
    }


@pytest.mark.slow
def test_figures_print_on_a_page_with_letters_to_read_and_have_rpm_beside_every_speed(drawn):
    for name, figure in drawn.items():
        figure.canvas.draw()
        assert figure.get_figwidth() <= style.PAGE, name
        letters = [text for text in figure.findobj(Text) if text.get_text() and text.get_visible()]
        assert min(text.get_fontsize() for text in letters) >= 6.0, name
        labels = texts(figure.findobj(Text))
        # percent of each blade's own crossing is no speed
        assert ("rpm" in labels) == any("rad/s" in label for label in labels), name


def map_of(datasets, kind, draw, factor=1.0):
    """A map of Ref in abradable contact, and the part of the dataset that it shows, times a factor."""
    shown = factor * datasets[kind].sel(blade="Ref", scene="abradable")
    return draw(shown, datasets["campbell"].sel(blade="Ref"), "Ref, abradable"), shown


@pytest.mark.parametrize("draw, kind, panels", [(maps.draw_spectral_map, "spectrum", 2), (maps.draw_wear_map, "wear", 1)])
def test_a_map_of_runs_that_all_diverged_says_so(datasets, draw, kind, panels):
    figure, _ = map_of(datasets, kind, draw, np.nan)
    figure.canvas.draw()
    assert [text for axes in figure.axes for text in texts(axes.texts)] == ["every run diverged"] * panels


def test_a_map_of_wear_marks_speeds_at_which_the_lining_is_worn_through(datasets):
    figure, wear = map_of(datasets, "wear", maps.draw_wear_map)
    (triangles,) = (line for line in figure.axes[0].lines if line.get_marker() == "v")
    worn_through = wear["speed"].values[wear["worn_through_share"].values > 0.0]
    assert 0 < len(worn_through) < wear.sizes["speed"]
    np.testing.assert_array_equal(triangles.get_xdata(), worn_through)


def test_speeds_that_are_cut_free_or_growing_have_open_markers(datasets):
    """In the colour of their curve, at their speeds; no others have one."""
    rms = datasets["rms"].sel(blade="Ref")
    states = xr.full_like(rms["status"], MotionAtEnd.LASTING)
    states.loc["abradable", 1725.0:1775.0] = MotionAtEnd.CUT_FREE
    states.loc["abradable", 1700.0] = MotionAtEnd.GROWING
    figure = response_curves.draw_response("Ref", None, rms.assign(motion_at_end=states))
    for axes in figure.axes[:2]:
        curve = next(line for line in axes.lines if line.get_label() == "abradable lining")
        for marker, label, speeds in (("o", "cut free at the end", [1725, 1750, 1775]), ("^", "growing at the end", [1700])):
            (open_ones,) = (line for line in axes.lines if line.get_label() == label)
            assert (open_ones.get_marker(), open_ones.get_fillstyle(), open_ones.get_color()) == (
                marker,
                "none",
                curve.get_color(),
            )
            np.testing.assert_array_equal(open_ones.get_xdata(), speeds)
            np.testing.assert_array_equal(open_ones.get_ydata(), curve.get_ydata()[np.isin(curve.get_xdata(), speeds)])
    assert {"cut free at the end", "growing at the end"} <= set(texts(figure.legends[0].get_texts()))


def test_runs_that_diverged_are_marked_at_the_upper_edge(datasets):
    """Whatever the scale: no number is worse."""
    lines = [line for axes in response(datasets, "L50").axes for line in axes.lines]
    crosses = [line for line in lines if line.get_marker() == "x" and line.get_label() == "diverged"]
    assert crosses
    for line in crosses:
        height = line.axes.transAxes.inverted().transform(line.get_transform().transform(line.get_xydata()))[:, 1]
        assert (height > 0.9).all() and (height < 1.0).all()


def test_a_blade_has_one_colour_everywhere(drawn, root):
    """In all figures, and in the explorer."""
    wanted = {blade: one["color"] for blade, one in style.blade_styles(BLADES).items()}
    assert len(set(wanted.values())) == 3
    for figure in drawn.values():
        for axes in figure.axes:
            found = {line.get_label(): to_hex(line.get_color()).upper() for line in axes.lines if line.get_label() in BLADES}
            assert found.items() <= wanted.items()
    many = style.blade_styles(range(20))
    assert len({tuple(one.values()) for one in many.values()}) == 20
    script = (root / "src/r37core/explorer/explorer.js").read_text()
    colours = script[script.index("const COLOURS") :].partition("]")[0]
    assert re.findall(r"#\w{6}", colours) == list(style.COLOURS)


def test_png_and_pdf_are_the_same_bytes_again(datasets, tmp_path):
    """Also of a picture that is rendered, which has the size of a page."""
    plt.imsave(tmp_path / "blades.png", np.linspace(0.0, 1.0, 30 * 60 * 3).reshape(30, 60, 3))
    of_scene = datasets["rms"].sel(scene="direct")
    for draw in (
        lambda: draw_comparison(datasets["campbell"], of_scene, None, "direct"),
        lambda: style.picture_figure(tmp_path / "blades.png"),
    ):
        found = []
        for name in ("one", "two"):
            files, figure = [tmp_path / f"{name}.png", tmp_path / f"{name}.pdf"], draw()
            style.save(figure, files, "What is seen.")
            found.append([file.read_bytes() for file in files])
        assert found[0] == found[1]
        assert b"CreationDate" not in found[0][1]
        assert Image.open(tmp_path / "one.png").text["Description"] == "What is seen."
    assert tuple(figure.get_size_inches()) == pytest.approx((style.PAGE, style.PAGE / 2))


def test_a_user_s_matplotlibrc_changes_no_figure(tmp_path):
    """It may ask for LaTeX on a machine without."""
    (tmp_path / "matplotlibrc").write_text("text.usetex: True\nfont.size: 20\nimage.cmap: gray\n")
    code = (
        "from r37core.figures import style; print(*(style.plt.rcParams[n] for n in ('text.usetex', 'font.size', 'image.cmap')))"
    )
    environment = os.environ | {"MATPLOTLIBRC": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False", "8.0", "viridis"]


def test_blades_of_several_materials_have_a_yield_line_each(datasets):
    """Dashed lines of the last panel at their stress (GPa), and the texts beside them."""
    for limits, heights, blades in (([1.38e9] * 3, [1.38], []), ([1.38e9, 0.9e9, 1.38e9], [0.9, 1.38], ["L50", "Ref, S100"])):
        axes = compared(datasets, yield_stress=("blade", limits)).axes[2]
        dashed = [line for line in axes.lines if line.get_linestyle() == "--" and line.get_color() == "0.3"]
        assert [float(line.get_ydata()[0]) for line in dashed] == pytest.approx(heights)
        assert texts(axes.texts) == blades


def test_spectral_map_has_every_speed_on_its_own_scale(datasets):
    """Beside the peak, a thousandth of its motion is as bright; how much it is stands above."""
    figure, spectra = map_of(datasets, "spectrum", maps.draw_spectral_map)
    strip, picture = figure.axes[0], figure.axes[2].images[0]
    shown = np.asarray(picture.get_array())
    np.testing.assert_allclose(shown[1:].max(axis=0), 0.0, atol=1e-12)
    assert picture.get_clim() == (-60.0, 0.0)
    np.testing.assert_allclose(strip.lines[0].get_ydata(), 1e3 * spectra["amplitude"].max("engine_order"))
    assert "dB" in figure.axes[-1].get_xlabel()


def test_stress_above_yield_is_tinted_and_outside_the_model_only_where_that_is_linear(datasets):
    kinds = {"11 patches: Ref": style.OUTSIDE, "patches, quadratic: Ref": style.ABOVE_YIELD}
    for contact, said in (kinds | {"patches, quadratic: Ref; patches: Other": style.ABOVE_YIELD}).items():
        figure = response(datasets, contact=contact)
        axes = figure.axes[2]
        (tint,) = axes.patches
        assert tint.get_y() == pytest.approx(1.38)
        assert axes.get_ylim()[1] < 10.0 < tint.get_y() + tint.get_height()
        assert figure.legends[0].get_texts()[-1].get_text() == said
    # of a single response
    assert not style.is_linear(xr.Dataset(attrs={"contact": "patches", "kinematics": "quadratic"}))


def test_stress_is_a_band_from_the_largest_inside_the_model_to_that_of_all_revolutions(datasets):
    """From 0, like the motion; also of a speed without neighbours, with the region that decides."""
    of = {kind: datasets[kind].sel(blade="Ref", speed=[900.0, 1700.0]).copy(deep=True) for kind in ("rms", "stress")}
    for name in ("inside", "ever"):
        of["stress"][f"max_von_mises_{name}"].loc["abradable", 900.0] = np.nan
    for figure, stress in (
        (response_curves.draw_response("Ref", None, **of), of["stress"].sel(scene="abradable")),
        (compared(datasets), datasets["stress"].sel(scene="abradable", blade="Ref")),
    ):
        assert [axes.get_ylim()[0] for axes in figure.axes[:3]] == [0.0] * 3
        axes = figure.axes[2]
        inside, largest = (line.get_ydata() for line in axes.lines[:2])
        assert inside.max() == pytest.approx(1e-9 * float(stress["max_von_mises_inside"].max()))
        np.testing.assert_allclose(largest, 2.0 / 1.6 * inside)
        assert axes.get_ylabel() == "von Mises (GPa)\ninside the model\nto largest of all\nairfoil"
        assert any(isinstance(one, PolyCollection) for one in axes.collections)


def test_rows_show_where_a_blade_is_dangerous_unknown_and_sustained_and_by_which_limit(datasets):
    """Dark, hatched, with a line, and with the limits by which the model is left before yield; so also without stress."""
    figure = response(datasets)
    (rows,) = (axes for axes in figure.axes if ticks(axes) == ["abradable lining", "bare casing"])
    places = {}
    for one in rows.collections:
        kind = "unknown" if one.get_hatch() else "ran" if one.get_alpha() else "dangerous"
        for path in one.get_paths():
            (low, bottom), (high, _) = path.vertices.min(axis=0), path.vertices.max(axis=0)
            places.setdefault((round(bottom + 0.38), kind), []).append((low, high))
    of_lining = datasets["stress"].sel(blade="Ref", scene="abradable")
    above = SPEEDS[(of_lining["max_von_mises_inside"] > of_lining["yield_stress"]).values]
    ((begin, end),) = places[0, "dangerous"]
    assert begin < above.min() and above.max() < end and end - begin < 2 * 25.0 * len(above)
    assert places[1, "unknown"] == places[1, "ran"] == [(750.0, 2000.0)] and (1, "dangerous") not in places
    (line,) = rows.lines
    assert line.get_ydata().tolist() == [0, 0] and 1675.0 < line.get_xdata()[0] < 1700.0 < line.get_xdata()[1] < 1725.0
    assert texts(rows.texts) == ["by force"]
    assert {"dangerous", "unknown", "sustained"} < {text.partition(":")[0] for text in texts(figure.legends[0].get_texts())}
    alone = response_curves.draw_response("Ref", None, datasets["rms"].sel(blade="Ref"))
    assert texts(alone.axes[2].texts) == ["by force", "by force"]


def ranking(*rows):
    """ranking.csv of blades, scenes, lowest and highest ranks and lengths of the dangerous speeds.

    The length of unknown ones is 5, of sustained 9 rad/s more.
    """
    table = pd.DataFrame(rows, columns=["blade", "scene", "rank_lowest", "rank_highest", _DANGEROUS])
    table = table.astype({"rank_lowest": "Int64", "rank_highest": "Int64"})
    lengths = {"length_unknown_rad_s": 5.0, "length_most_revolutions_rad_s": table[_DANGEROUS] + 9.0}
    lengths |= dict.fromkeys(("runs_left_by_height", "runs_left_by_energy"), 0.0)
    lengths |= dict.fromkeys(("runs_left_by_force", "runs_left_by_heat"), 2.0)
    return table.assign(**lengths, contact="11 patches", length_dangerous_within_rad_s=12.0)


_DANGEROUS = "length_dangerous_rad_s"


def ticks(axes):
    return texts(axes.get_yticklabels())


def test_the_places_that_a_blade_may_have_stand_before_its_name():
    """In each scene by its own ranks; where all tie, there is no order."""
    rows = [
        ("B", "x", 1, 1, 5.0),
        ("A", "x", 2, 3, 20.0),
        ("C", "x", 2, 3, 22.0),
        *((name, "y", 1, 3, length) for name, length in (("C", 0.0), ("A", 1.5), ("B", 2.0))),
    ]
    figure = comparison.draw_ranking(ranking(*rows))
    first, second = figure.axes
    assert [ticks(axes) for axes in figure.axes] == [
        ["1  B", "2 to 3  A", "2 to 3  C"],
        ["1 to 3  C", "1 to 3  A", "1 to 3  B"],
    ]
    assert [axes.get_title() for axes in figure.axes] == ["x", "y: cannot be ranked"]
    assert figure.get_suptitle() == "contact: 11 patches; kinematics: linear"
    assert sorted(patch.get_width() for patch in first.patches) == [5.0, 5.0, 5.0, 5.0, 20.0, 22.0]
    assert "0 / 5 / 9 by force, heat" in texts(second.texts)
    # known to within more than the length: the error bar ends at 0
    ends = second.collections[1].get_segments()
    assert [(begin[0], end[0]) for begin, end in ends] == [(0.0, 12.0), (0.0, 13.5), (0.0, 14.0)]


def test_ranks_are_among_blades_of_one_contact_and_of_many_blades_some_are_left_out():
    places = (("B", 1, 5.0), ("A", 2, 20.0), ("Mine", 1, 22.0), ("Other", pd.NA, np.nan))
    table = ranking(*((name, "x", place, place, length) for name, place, length in places))
    figure = comparison.draw_ranking(table.assign(contact=["8 points", "8 points", "12 patches", "12 patches"]))
    assert ticks(figure.axes[0]) == ["1  B\n8 points", "2  A\n8 points", "1  Mine\n12 patches", "Other\n12 patches"]
    assert figure.get_suptitle() == ""
    rows = [(f"blade_{number}", "x", 1 + number, 1 + number, float(number)) for number in range(90)]
    many = comparison.draw_ranking(ranking(*rows))
    named = [f"{1 + number}  blade_{number}" for number in range(90)]
    assert ticks(many.axes[0]) == [*named[:30], "(30 more)", *named[60:]]


def test_comparison_takes_the_order_that_most_blades_meet(datasets):
    assert comparison.shared_order(datasets["campbell"], 750.0, 2000.0) == 4
    assert comparison.shared_order(datasets["campbell"], 750.0, 1300.0) == 5
    assert comparison.shared_order(datasets["campbell"], 750.0, 800.0) is None
    # where no blade meets one there is a figure nevertheless
    alone = draw_comparison(datasets["campbell"], datasets["rms"].sel(scene="direct", speed=[750.0, 775.0]), None, "direct")
    assert alone.axes[0].texts[0].get_text().startswith("no crossing of 1B was run")


def test_comparison_names_each_blade_that_it_does_not_draw(datasets):
    """One whose crossing lies outside the speeds that were run, and one without any: it may be the better design."""
    few = {kind: datasets[kind].sel(scene="abradable", speed=slice(1650.0, 2000.0)) for kind in ("rms", "stress")}
    crossing = datasets["campbell"].copy(deep=True)
    crossing["crossing_speed"].loc[{"blade": ["L50", "S100"], "mode": "1B", "engine_order": 4}] = [1500.0, np.nan]
    figure = draw_comparison(crossing, few["rms"], few["stress"], "abradable")
    assert {line.get_label() for line in figure.axes[0].lines} & {*BLADES} == {"Ref"}
    assert figure.axes[0].get_title().endswith("their own crossing was run: L50 (1500 rad/s), S100 (no crossing)")
    assert compared(datasets).axes[0].get_title() == "blades in scene abradable"


def test_comparison_is_over_each_blade_s_own_crossing(datasets):
    curves = {line.get_label(): line for line in compared(datasets).axes[0].lines if line.get_label() in BLADES}
    for blade, line in curves.items():
        x, y = line.get_data()
        assert x.min() >= -2.0 and x.max() <= 6.0
        crossing = float(datasets["campbell"]["crossing_speed"].sel(blade=blade, mode="1B", engine_order=4))
        speed = crossing * (1.0 + 0.01 * float(x[np.argmax(y)]))
        assert abs(speed - 1.02 * crossing) < 25.0


def test_interactions_are_circles_whose_area_is_their_length_above_yield(datasets):
    """Crosses are for what diverged; what has no engine order lies below 0, and what is higher than the panel at its edge."""
    figure = draw_interactions(
        datasets,
        {},
        {"blade": "L50", "engine_order": 6, "peak_speed_rad_s": 1200.0, "length_dangerous_rad_s": 5.0},
        {"engine_order": pd.NA, "peak_speed_rad_s": 1500.0, "length_dangerous_rad_s": 48.6},
        {"engine_order": pd.NA, "peak_speed_rad_s": 1900.0, "status": "diverged", "length_dangerous_rad_s": 0.0},
        {"peak_speed_rad_s": 1000.0, "status": "diverged", "length_dangerous_rad_s": 10.0},
        {"blade": "S100", "engine_order": 30, "peak_speed_rad_s": 1900.0, "length_dangerous_rad_s": 10.0},
    )
    axes = scenes_of(figure)[0]
    found = {float(speed): (frequency, area) for speed, frequency, area in circles(axes)}
    assert sorted(found) == [1000.0, 1200.0, 1500.0, 1700.0, 1900.0]
    assert found[1200.0][0] == pytest.approx(6 * 1200.0 / (2 * np.pi))
    bottom, top = axes.get_ylim()
    assert found[1500.0][0] == pytest.approx(0.5 * bottom)
    assert bottom < found[1900.0][0] < top and axes.get_title().endswith(" (circles at the top edge: higher)")
    assert [found[speed][1] / found[1700.0][1] for speed in (1000.0, 1200.0, 1500.0)] == pytest.approx([0.5, 0.25, 2.43])
    crosses = [place for line in axes.lines if line.get_label() == "diverged" for place in line.get_xydata().tolist()]
    assert crosses == [[1900.0, pytest.approx(0.5 * bottom)], [1000.0, pytest.approx(4 * 1000.0 / (2 * np.pi))]]
    assert {"Ref 1B/4, 20 rad/s", "L50 1B/6, 5 rad/s", "Ref, 49 rad/s"} <= set(texts(axes.texts))
    assert "no order" in ticks(axes)
    assert {*BLADES, "diverged"} == set(texts(figure.legends[0].get_texts()))
    assert "no interaction was found" in texts(scenes_of(figure)[1].texts)


def test_no_interaction_that_was_above_yield_looks_like_one_that_never_was(datasets):
    """A hatched diamond where the model is left first; an open ring only below yield; and a line along the speeds of a row."""
    none = {"length_dangerous_rad_s": 0.0}
    ends = {"from_rad_s": 1150.0, "to_rad_s": 1260.0}
    figure = draw_interactions(
        datasets,
        {},
        none | ends | {"peak_speed_rad_s": 1200.0, "length_unknown_rad_s": 3.0},
        none | {"peak_speed_rad_s": 900.0},
        {"peak_speed_rad_s": 1000.0, "length_dangerous_rad_s": np.nan, "length_unknown_rad_s": np.nan},
    )
    axes = scenes_of(figure)[0]
    looks = {
        float(one.get_offsets()[0][0]): (len(one.get_paths()[0]), one.get_facecolors()[0][3], bool(one.get_hatch()))
        for one in marks(axes)
    }
    diamond, ring = (len(MarkerStyle(shape).get_path()) for shape in "Do")
    below = (ring, 0.0, False)
    assert looks == {1700.0: (ring, 0.45, False), 1200.0: (diamond, 0.0, True), 900.0: below, 1000.0: below}
    (line,) = (line for line in axes.lines if line.get_xdata().tolist() == [1150.0, 1260.0])
    np.testing.assert_allclose(line.get_ydata(), 4 * np.array([1150.0, 1260.0]) / (2 * np.pi))
    assert "Ref 1B/4, unknown after 4.5 x yield" in texts(axes.texts)
    keys = figure.legends[1].get_texts()
    assert texts(keys) == ["dangerous", "unknown: model left first", "below yield", "stress not known", "sustained"]


def test_labels_of_interactions_do_not_lie_on_each_other_and_say_where_the_speeds_end(datasets):
    one = {kind: datasets[kind].sel(blade=["Ref"]) for kind in ("campbell", "rms", "stress")}
    rows = [{"peak_speed_rad_s": 1600.0 + 20.0 * n, "length_dangerous_rad_s": 30.0 - n} for n in range(12)]
    figure = draw_interactions(one, *rows, {"length_dangerous_rad_s": 98.4, "dangerous_to_rad_s": 2000.0})
    labels = [text for text in scenes_of(figure)[0].texts if "rad/s" in text.get_text()]
    assert len(labels) == 5
    assert labels[0].get_text() == "1B/4, > 98 rad/s"
    boxes = [text.get_window_extent() for text in labels]
    assert not any(box.count_overlaps(boxes[:number]) for number, box in enumerate(boxes))


def test_a_combination_has_its_own_line_through_its_mark(datasets):
    """Dashed, the difference of the frequencies over speed; a panel without one has none."""
    figure = draw_interactions(datasets, {}, {"mode": "1T-1B", "engine_order": 6}, {"scene": "direct", "blade": "L50"})
    dashed, none = ([line for line in axes.lines if line.get_linestyle() == "--"] for axes in scenes_of(figure)[:2])
    frequency = datasets["campbell"]["frequency"]
    difference = frequency.sel(mode="1T") - frequency.sel(mode="1B")
    np.testing.assert_allclose([line.get_ydata() for line in dashed], [difference.min("blade"), difference.max("blade")])
    assert not none and {"1T-1B"} < set(texts(scenes_of(figure)[0].texts))


def test_interactions_without_stress_are_as_large_as_their_motion(datasets):
    unknown = {"length_dangerous_rad_s": np.nan}
    figure = draw_interactions(datasets, unknown, unknown | {"peak_motion_m": 0.0025, "peak_speed_rad_s": 1200.0})
    (_, _, area), (_, _, smaller) = circles(scenes_of(figure)[0])
    assert smaller == pytest.approx(0.25 * area)
    assert "Ref 1B/4, 10 mm" in texts(scenes_of(figure)[0].texts)


def test_a_run_without_interactions_says_so_and_of_many_scenes_the_longest_are_drawn(datasets, tmp_path):
    interactions().to_csv(tmp_path / "summary.csv", index=False)
    figure = interaction_map.draw_interactions(datasets["campbell"], datasets["rms"], read_table(tmp_path / "summary.csv"))
    assert all("no interaction was found" in texts(axes.texts) for axes in scenes_of(figure)[:2])
    scenes = [f"scene{number}" for number in range(8)]
    many = datasets | {"rms": datasets["rms"].isel(scene=[0] * 8).assign_coords(scene=scenes)}
    rows = [{"scene": scene, "length_dangerous_rad_s": 9.0 - n} for n, scene in enumerate(scenes)]
    figure = draw_interactions(many, *rows)
    assert [axes.get_title() for axes in scenes_of(figure)] == scenes[:6]


def test_scenes_share_a_scale(datasets):
    for length in (10.0, 2.0, 0.5):
        figure = draw_interactions(datasets, {}, {"scene": "direct", "length_dangerous_rad_s": length})
        first, second = (circles(axes)[0][2] for axes in scenes_of(figure)[:2])
        # no circle is too small to be seen
        assert second == pytest.approx(max(length / 20.0 * first, 25.0))


def test_every_figure_of_the_rules_has_a_caption_and_is_in_the_report(root):
    assert len({figure.rule for figure in FIGURES}) == len({figure.name for figure in FIGURES}) == len(FIGURES)
    for file in (root / "workflow/rules").glob("*.smk"):
        rules = re.split(r"^ *(?:use )?rule\b", file.read_text(), flags=re.MULTILINE)
        for rule in (block for block in rules[1:] if "/figures/" in block):
            # `pictures` puts them into the report
            assert re.search(r"output:\s+\*\*pictures\(", rule), rule
            assert "caption=" in rule or "drawing(figure, sweep)" in rule, rule
