"""Families of designs, of blades and of scenes, and scenes that start from others: names, refusals, and what is compared."""

import json
import re
from itertools import product
from types import SimpleNamespace

import jsonschema
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from call_counts import calls_of
from stubbed_runs import copy_stubbed
from workflow_runs import overlay, planned_outputs, snakemake

from r37core.base.plain import to_plain
from r37core.base.yaml_file import load_yaml
from r37core.config import ConfigError, command_line_document, plain
from r37core.config.families import design_name
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.product.targets import FIGURES, drawing, targets
from r37core.results.columns import names
from r37core.time_integration.status import RunStatus
from r37studies.designs.compared import Compared
from r37studies.designs.figures import draw_designs
from r37studies.designs.maps import contents, draw_design_map
from r37studies.designs.plan import EXTENSION, Families
from r37studies.designs.table import MEASURES, compared_in, design_table
from r37studies.run_ups.plan import RunUps

SWEEP = "Sweep:\n  base: S100\n  vary:\n    sweep_percent: { start: -50, stop: 150, step: 100 }\n"
GRID = "Grid:\n  base: Ref\n  vary:\n    chordwise_sweep_deg: [-2.5, 5]\n    material.density_kg_m3: [8000, 4500]\n"


def test_a_range_becomes_blades_with_readable_names(with_blades):
    settings = with_blades(SWEEP)
    assert list(settings.blades)[7:] == ["Sweep_-50", "Sweep_50", "Sweep_150"]
    tips = [settings.blades[name].definition.stacking[-1] for name in list(settings.blades)[7:]]
    np.testing.assert_allclose(tips, [(1.0, -0.003, 0.0), (1.0, 0.003, 0.0), (1.0, 0.009, 0.0)])
    # half the sweep of S100 is the benchmark's S50
    np.testing.assert_allclose(settings.blades["Sweep_50"].definition.stacking, settings.blades["S50"].definition.stacking)
    assert design_name("F", (-0.5, 1e-7, 2.0)) == "F_-0p5_1e-07_2"


def test_a_family_is_refused_once(with_blades):
    rows = "".join(f"D{number},{number / 100}\n" for number in range(200))
    with pytest.raises(ConfigError) as refusal:
        with_blades(
            "Mine: { base: L50, chord_percent: 1000, designs: config/designs.csv }\n",
            f"blade,stagger_deg\n{rows}",
            blades=["Mine"],
        )
    assert len(str(refusal.value).splitlines()) == 1 and "D0" in str(refusal.value)


def test_a_family_has_run_ups_of_all_its_designs_and_figures_of_some(with_blades):
    """Blades with figures, of many: those of no family, and six designs from the first to the last."""
    run_ups = {"up": {"from_rad_s": 900, "to_rad_s": 1000, "revolutions": 50, "blades": ["Sweep"]}}
    settings = with_blades(SWEEP.replace("step: 100", "step: 2"), blades=["Ref", "Sweep"], run_ups=run_ups)
    choices, designs = RunUps(Sweep(settings)).choices, [f"Sweep_{percent}" for percent in range(-50, 151, 2)]
    assert [name for name in settings.blades if choices[name, "direct"]] == designs
    drawn = Sweep(settings).drawn["blade"]
    assert drawn == ["Ref", "Sweep_-50", "Sweep_-10", "Sweep_30", "Sweep_70", "Sweep_110", "Sweep_150"]
    assert [names["blade"] for names in targets(Sweep(settings))["<results>/figures/response_{blade}.png"]] == drawn
    (overview,) = (figure for figure in FIGURES if figure.rule == "comparison_figure")
    parameters = drawing(SimpleNamespace(step=lambda *_: {}), None, overview, Sweep(settings))
    assert parameters["caption"]({"scene": "direct"}).endswith("(light). 7 of 102 blades are drawn.")


def test_a_grid_has_every_value_with_every_other(with_blades):
    settings = with_blades(GRID)
    names = ["Grid_-2p5_8000", "Grid_-2p5_4500", "Grid_5_8000", "Grid_5_4500"]
    assert list(Families(settings).families["blade"]["Grid"]) == names
    assert settings.blades["Grid_5_4500"].material.density == 4500.0
    assert settings.blades["Grid_5_4500"].material.youngs_modulus == 180e9
    assert settings.blades["Grid_-2p5_8000"].definition.chordwise_sweep_angle == pytest.approx(np.radians(-2.5))


def test_a_table_has_one_design_a_row(with_blades):
    table = "blade,chordwise_sweep_deg,material.density_kg_m3\nForward,5,8000\nBack-1,-5,7.5e3\n"
    settings = with_blades("Mine: { base: Ref, designs: config/designs.csv }\n", table, blades=["Mine", "Ref"])
    assert list(settings.blades) == ["Forward", "Back-1", "Ref"]
    keys = "chordwise_sweep_deg", "material.density_kg_m3"
    designs = {"Forward": (5.0, 8000.0), "Back-1": (-5.0, 7500.0)}
    assert Families(settings).families["blade"]["Mine"] == {
        name: dict(zip(keys, values, strict=True)) for name, values in designs.items()
    }
    assert settings.blades["Back-1"].material.density == 7500.0


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("blade,chordwise_sweep_deg\nA,x\n", r"csv: family Mine: line 2, column chordwise_sweep_deg: 'x' is not"),
        (f"blade,chordwise_sweep_deg\nA,{'1' * 131_073}\n", r"csv: family Mine: line 2: not readable as a table"),
        ("blade,chordwise_sweep_deg\nA,1\nA,2\n", r"designs\.csv: family Mine: the blade 'A' is given twice"),
        ("chordwise_sweep_deg\n1\n", r"family Mine: line 1: the table lacks the columns blade"),
        ("blade,chordwise_sweep_deg\n" + "".join(f"A{n},1\n" for n in range(10_001)), "Mine.*: found 10001 designs"),
        ("blade,chordwise_sweep_deg\n", r"family Mine: the table has no designs"),
        ("blade,chordwise_sweep_deg\nA__b,1\n", r"yaml:\d+: A__b: found 'A__b'; allowed: a name .* \(given by 'Mine'\)"),
        ("blade,chordwise_sweep_deg\nRef,1\n", r"Mine: found the design 'Ref'; allowed: designs that are not named like"),
    ],
)  # fmt: skip
def test_table_refusals(with_blades, table, message):
    with pytest.raises(ConfigError, match=message):
        with_blades("Mine: { base: Ref, designs: config/designs.csv }\n", table)


@pytest.fixture
def compared():
    """Two designs in a scene with stress and one without."""
    blades = {"blade": ["F_1", "F_2"]}
    campbell = xr.Dataset(
        {
            "frequency": (("blade", "mode", "speed"), [[[800.0], [2500.0]], [[700.0], [2400.0]]]),
            "dynamic_clearance": (("blade", "mode", "tangential_displacement"), [[[-3e-4, 1e-4]] * 2] * 2),
        },
        blades | {"mode": ["1B", "1T"], "speed": [0.0]},
    )
    over, where = ("blade", "scene", "speed"), blades | {"scene": ["lined", "bare"], "speed": [900.0, 910.0, 920.0]}
    status, motion = np.zeros((2, 2, 3)), ((*over, "tip_point"), np.full((2, 2, 3, 2), 1e-3))
    status[0, :, 2] = RunStatus.NOT_RUN
    rms = xr.Dataset(
        {
            **{"rms_normal": motion, "rms_tangential": motion, "status": (over, status)},
            **{"exit_revolution": (over, np.full((2, 2, 3), np.nan)), "exit_cause": (over, np.zeros((2, 2, 3), "i1"))},
        },
        where | {"tip_point": ["leading_edge", "trailing_edge"]},
    )
    largest = (over, [[[1e9, 3e9, np.nan]], [[1e9, 1e9, 1e9]]])
    stress = xr.Dataset(
        {
            **{f"max_von_mises_{name}": largest for name in ("high", "median", "ever", "inside")},
            "share_of_revolutions_above_yield": (over, [[[0.0, 1.0, np.nan]], [[0.0, 0.0, 0.0]]]),
            "yield_stress": (("blade", "scene"), [[2e9], [2e9]]),
            "status": (over, status[:, :1]),
        },
        where | {"scene": ["lined"]},
    )
    interactions = pd.DataFrame(
        [("F_1", "lined", "1B", 1e-3, 30.0), ("F_1", "lined", "1B", 5e-3, 50.0), ("F_1", "lined", np.nan, 9e-3, np.nan)],
        columns=["blade", "scene", "mode", "peak_rms_tangential_m", "shift_rad_s"],
    )
    variables = {"blade": {"F_1": {"sweep_percent": 1.0}, "F_2": {"sweep_percent": 2.0}}, "scene": {}}
    datasets = {"campbell": campbell, "rms": rms, "stress": stress}
    pairs = dict.fromkeys(product(("F_1", "F_2"), ("lined", "bare")), 0.0)
    families = {"blade": {"F_1": "F", "F_2": "F"}, "scene": {}}
    return design_table(pairs, variables, families, {"F_1": 0.2, "F_2": 0.3}, datasets, interactions)


def test_designs_are_compared(compared):
    assert list(compared.columns) == ["blade", "scene", "family", "sweep_percent", *names(MEASURES)]
    rows = compared.set_index(["blade", "scene"])
    one = rows.loc["F_1", "lined"]
    assert (one["mass_kg"], one["frequency_1b_hz"], one["frequency_1t_hz"]) == (0.2, 800.0, 2500.0)
    assert one["clearance_loss_1b_m"] == 3e-4
    keys = ["length_dangerous_rad_s", "first_dangerous_rad_s", "largest_median_stress_pa"]
    assert one[keys].tolist() == [5.0, 905.0, 3e9]
    # of the two peaks of 1B the one with the larger motion
    assert one["shift_1b_rad_s"] == 50.0
    other = rows.loc["F_2", "lined"]
    assert other["length_dangerous_rad_s"] == other["length_most_revolutions_rad_s"] == 0.0
    assert np.isnan(other["first_dangerous_rad_s"])
    assert np.isnan(other["shift_1b_rad_s"])
    assert np.isnan(rows.loc["F_1", "bare"]["largest_median_stress_pa"])


def test_a_family_is_drawn(compared):
    names = (("F_1", "F_2"), ("lined", "bare"))
    figure = draw_designs("F", compared, to_plain(Compared("blade", ("sweep_percent",), *names)))
    assert len(figure.axes) == 12
    assert list(figure.axes[0].lines[0].get_xdata()) == [1.0, 2.0]
    figure = draw_designs("F", compared.assign(other=0.0), to_plain(Compared("blade", ("sweep_percent", "other"), *names)))
    assert [label.get_text() for label in figure.axes[9].get_xticklabels()] == ["F_1", "F_2"]


@pytest.fixture
def with_scenes(config_copy):
    """Settings of a copy, with some text added to scenes.yaml and, if given, a table of designs and other changes."""

    def read(text, table="", scenes="all", **changes):
        with open(config_copy / "config/scenes.yaml", "a") as stream:
            stream.write(f"{text}\n")
        (config_copy / "config/rooms.csv").write_text(table)
        return read_settings(config_copy, command_line_document({"scenes": scenes, **changes}))

    return read


def test_a_scene_has_what_it_leaves_out_from_its_base(with_scenes):
    """Key by key inside sections, through several bases, in any order; lists are replaced, and null takes away."""
    entries = with_scenes(
        "Thinner: { base: Thin, casing: { lobes: 3, ring: null }, results: [stress] }\n"
        "Thin: { base: elastic_abradable, lining: { thickness_m: 0.003 }, until: null }\n"
        "Bare: { base: Thinner, lining: null, friction: null }"
    ).scene_designs.entries
    shipped, thin, thinner, bare = (plain(entries[name]) for name in ("elastic_abradable", "Thin", "Thinner", "Bare"))
    assert thin == shipped | {"lining": shipped["lining"] | {"thickness_m": 0.003}}
    casing = {key: value for key, value in shipped["casing"].items() if key != "ring"} | {"lobes": 3}
    assert thinner == thin | {"casing": casing, "results": ["stress"]}
    assert bare == {key: value for key, value in thinner.items() if key not in ("lining", "friction")}


def test_the_page_has_scenes_of_one_s_own(with_scenes, root):
    page = (root / "docs/blades.md").read_text()
    text = next(text for text in re.findall(r"```yaml\n(.*?)```", page, re.DOTALL) if text.startswith("Thin:"))
    entries = with_scenes(text).scene_designs.entries
    assert entries["Thin"].lining.thickness_m == 0.003 and entries["Thin"].lining.contact_length_m == 1.585e-4
    assert entries["Round"].lining is None and entries["Round"].casing.lobes == 0


def test_a_family_may_have_a_base(with_scenes):
    entries = with_scenes("Rooms: { base: direct, vary: { casing.clearance_m: [3.0e-4, 5.0e-4] } }").scene_designs.entries
    for name, clearance in (("Rooms_0p0003", 3e-4), ("Rooms_0p0005", 5e-4)):
        assert entries[name].casing.clearance_m == clearance
        assert entries[name].friction == entries["direct"].friction


def test_a_wrong_value_of_a_base_is_told_once_and_of_the_base(with_scenes, config_copy):
    file = config_copy / "config/scenes.yaml"
    file.write_text(file.read_text().replace("thickness_m: 0.005", "thickness_m: -1"))
    with pytest.raises(ConfigError) as refusal:
        with_scenes("X: { base: material_abradable }")
    assert str(refusal.value).startswith("config/scenes.yaml:10: abradable.lining.thickness_m: found -1; allowed: number")
    assert "\n" not in str(refusal.value)


def test_the_schema_for_editors_knows_bases(config_copy):
    schema = json.loads((config_copy / "config/schemas/scenes.schema.json").read_text())
    entries = load_yaml(config_copy / "config/scenes.yaml")
    jsonschema.validate(entries, schema)
    for wrong, message in (({"lining": {"thicknes_m": 1}}, "thicknes_m"), ({"lining": {"thickness_m": -1}}, "-1 is less")):
        with pytest.raises(jsonschema.ValidationError, match=message):
            jsonschema.validate(entries | {"X": {"base": "abradable", **wrong}}, schema)
        with pytest.raises(jsonschema.ValidationError, match="required"):
            jsonschema.validate(entries | {"X": {"casing": {"clearance_m": 1e-3}, "lining": {"thickness_m": 1}}}, schema)


CASING = "casing: { clearance_m: 4.0e-4, lobes: 2, width: 0.15, amplitude_m: 7.0e-4 }"
LINING = "lining: { thickness_m: 0.005, elastic_modulus_pa: 2.0e+10, plastic_modulus_pa: 5.0e+9, yield_stress_pa: 1.5 }"
ROOM = (
    f"Room:\n  {CASING}\n  {LINING}\n  results: [stress, wear]\n  friction: {{ coefficient: 0.15 }}\n"
    "  vary:\n    casing.clearance_m: [3.0e-4, 6.0e-4]\n    lining.thickness_m: [0.001, 0.002, 0.005]\n"
)
LOBES = f"Lobes:\n  {CASING}\n  vary: {{ casing.lobes: [2, 3] }}\n"
TWO_SWEEPS = "Sweep: { base: S100, vary: { sweep_percent: [50, 100] } }"


@pytest.mark.parametrize(
    ("key", "given", "values"),
    [
        ("casing.lobes", "[2, 3]", [2, 3]),
        ("revolutions", "[20, 40]", [20, 40]),
        ("lining.bar_area_m2", "{ start: 2.4e-9, stop: 3.6e-9, step: 4.0e-10 }", [2.4e-9, 2.8e-9, 3.2e-9, 3.6e-9]),
    ],
)
def test_numbers_of_a_family_stay_what_they_are(with_scenes, key, given, values):
    """Whole ones, also where the scene does not write them, and small ones."""
    settings = with_scenes(f"Mine: {{ {CASING}, {LINING}, vary: {{ {key}: {given} }} }}", scenes=["Mine"], blades=["Ref"])
    found = [design[key] for design in settings.scene_designs.families["Mine"].values()]
    assert found == values


def test_the_cost_of_a_table_of_scenes_rises_with_its_rows(with_scenes):
    """It rose with their square."""

    def read(rows):
        table = "scene,damping_ratio\n" + "".join(f"Room{number},{1e-3 + 1e-7 * number:.9f}\n" for number in range(rows))
        family = f"Room: {{ {CASING}, designs: config/rooms.csv }}"
        return with_scenes(family, table, scenes=["Room"], blades=["Ref"], speeds=[900])

    settings = read(9000)
    assert len(settings.scenes) == 9000 and settings.scenes["Room5000"].scene.damping_ratio == pytest.approx(1.5e-3)
    assert calls_of(read, 2000) < 2.5 * calls_of(read, 1000)


def test_sections_name_families_of_scenes(with_scenes):
    settings = with_scenes(
        ROOM,
        scenes=["Room", "direct"],
        blades=["Ref"],
        speeds_for=[{"scenes": ["Room"], "speeds": [1150.0]}],
        tolerances={"scenes": ["Room"], "members": 2, "of_scenes": {"friction.coefficient": {"uniform_percent": 5}}},
        run_ups={"up": {"from_rad_s": 1100, "to_rad_s": 1110, "rate_rad_s2": 100, "scenes": ["Room"]}},
    )
    ruled = {scene for (_, scene), plan in settings.speed_plans.items() if list(plan.certain) == [1150.0]}
    assert ruled | {"direct"} == set(settings.scene_names) and "direct" not in ruled


def test_a_family_of_scenes_is_not_called_like_one_of_blades(with_scenes, config_copy):
    with open(config_copy / "config/blades.yaml", "a") as stream:
        stream.write(f"\n{TWO_SWEEPS.replace('Sweep', 'Room')}\n")
    with pytest.raises(ConfigError, match=r"scenes\.yaml.*'Room', which is a family of blades"):
        with_scenes(ROOM)


def test_what_is_compared_and_drawn(with_scenes, config_copy):
    with open(config_copy / "config/blades.yaml", "a") as stream:
        stream.write(f"\n{TWO_SWEEPS}\n")
    settings = with_scenes(ROOM + LOBES, scenes=["Room", "Lobes", "direct"], blades=["Sweep", "Ref"])
    families = Families(settings)
    assert families.variables["scene"]["Room_0p0006_0p002"] == dict(zip(KEYS, (6e-4, 0.002), strict=True))
    # of Ref in `direct` nothing varies
    assert ("Ref", "direct") not in families.pairs
    assert ("Sweep_50", "direct") in families.pairs
    assert len(families.pairs) == 3 * 9 - 1
    assert families.figures["Sweep"].scenes == ("direct",)
    assert families.figures["Room"].blades == ("Sweep_50", "Sweep_100", "Ref")
    assert list(families.maps) == ["Room", "Sweep__Lobes"]
    assert families.maps["Sweep__Lobes"].keys == ("sweep_percent", "scene.casing.lobes")
    files = EXTENSION.all_targets(Sweep(settings))
    assert [names["family"] for names in files["<results>/figures/map_{family}.png"]] == ["Room", "Sweep__Lobes"]


def test_scenes_of_a_family_are_drawn_beside_others_six_at_most(with_scenes):
    few = Sweep(with_scenes(ROOM, scenes=["Room", "direct"], blades=["Ref"]))
    assert few.drawn["scene"] == few.settings.scene_names and "direct" in few.drawn["scene"]
    files = targets(few)
    assert [names["scene"] for names in files["<results>/figures/comparison_{scene}.png"]] == few.settings.scene_names
    thick = ROOM.replace("Room", "Wide").replace("lining.thickness_m: [", "lining.thickness_m: [0.0011, 0.0012, 0.0013, ")
    many = Sweep(with_scenes(thick, scenes=["Wide", "direct"], blades=["Ref"]))
    designs = [scene for scene in many.settings.scene_names if scene != "direct"]
    drawn = [scene for scene in many.drawn["scene"] if scene != "direct"]
    assert "direct" in many.drawn["scene"] and len(designs) > len(drawn) == 6
    assert [drawn[0], drawn[-1]] == [designs[0], designs[-1]]


KEYS = ("scene.casing.clearance_m", "scene.lining.thickness_m")


def table_of(lengths):
    """Lengths above yield over two clearances and two thicknesses, of one blade."""
    places = [(clearance, thickness) for clearance in (3e-4, 6e-4) for thickness in (0.001, 0.002)]
    rows = [("Ref", f"Room_{number}", "Room", *place) for number, place in enumerate(places)]
    return pd.DataFrame(rows, columns=["blade", "scene", "family", *KEYS]).assign(
        length_dangerous_rad_s=lengths, length_unknown_rad_s=0.0, length_dangerous_within_rad_s=4.0
    )


def map_of(table, verdict):
    (compared,) = compared_in(table).values()
    return draw_design_map("Room", table, to_plain(compared), verdict)


def test_a_map_has_values_in_place_and_the_line_of_a_requirement():
    table = table_of([40.0, 30.0, 20.0, 0.0])
    verdict = table[["blade", "scene"]].assign(requirement="above_yield", verdict=["fails", "fails", "fails", "meets"])
    assert list(compared_in(table).values()) == [Compared("scene", KEYS, ("Ref",), tuple(table["scene"]))]
    axes = map_of(table, verdict).axes[0]
    np.testing.assert_array_equal(axes.collections[0].get_array().reshape(2, 2), [[40.0, 20.0], [30.0, 0.0]])
    assert marks_of(axes, "meets all requirements") == ([1], [0.7])
    (limit,) = [collection for collection in axes.collections[1:] if collection.get_label() == "limit of above yield"]
    # round the design that meets it
    assert sorted(segment.tolist() for segment in limit.get_segments()) == [[[0.5, 0.5], [0.5, 1.5]], [[0.5, 0.5], [1.5, 0.5]]]
    # and not round holes
    axes = map_of(table.iloc[[0, 3]], verdict.assign(verdict="meets")).axes[0]
    assert not [collection for collection in axes.collections if str(collection.get_label()).startswith("limit")]


def marks_of(axes, label):
    (marks,) = (line for line in axes.lines if line.get_label() == label)
    return list(marks.get_xdata()), list(marks.get_ydata())


def test_a_map_without_a_speed_above_yield_shows_how_near_fatigue_is():
    table = table_of([0.0, 0.0, 0.0, 0.0])
    shares = {"requirement": "goodman_share", "verdict": "meets", "value_highest": [1.3, 0.9, 0.6, 0.25]}
    verdict = table[["blade", "scene"]].assign(**shares)
    figure = map_of(table, verdict)
    assert [text.get_text() for text in figure.axes[0].texts] == ["1.30", "0.60", "0.90", "0.25"]
    (shown,) = contents(table, verdict)
    assert (shown["label"], shown["digits"]) == (figure.axes[-1].get_ylabel(), 2)
    assert shown["label"] == "largest share of the Goodman line"
    assert shown["axes"] == [("casing, clearance (mm)", 1e3), ("lining, thickness (mm)", 1e3)]
    assert (figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()) == tuple(label for label, _ in shown["axes"])


def test_a_map_hatches_designs_with_unknown_speeds_and_has_both_ends_of_their_brackets():
    """In operation where its lengths are; in the explorer, too."""
    table = table_of([40.0, 0.0, 0.0, 0.0]).assign(length_unknown_rad_s=[0.0, 25.0, 0.0, 0.0])
    inside = {"length_dangerous_operating_rad_s": 2.0, "length_unknown_operating_rad_s": [0.0, 0.0, 0.0, 6.0]}
    for rows, texts, corner in (
        (table, ["40", "0", "0 to 25", "0"], (-0.5, 0.5)),
        (table.assign(**inside), ["2", "2", "2", "2 to 8"], (0.5, 0.5)),
    ):
        axes = map_of(rows, None).axes[0]
        assert [text.get_text() for text in axes.texts] == texts
        assert [patch.get_xy() for patch in axes.patches if patch.get_hatch()] == [corner]


@pytest.mark.slow
def test_one_more_value_runs_its_own_simulations(root, tmp_path):
    copy_stubbed(root, tmp_path)
    overlay(tmp_path, "config.yaml", "blades: [Ref]\nscenes: [Lobes]\nspeeds: [1000, 1100]")
    overlay(tmp_path, "scenes.yaml", LOBES)
    snakemake(tmp_path, "tables", "--cores", "2")
    overlay(tmp_path, "scenes.yaml", LOBES.replace("[2, 3]", "[2, 3, 5]"))
    jobs = planned_outputs(tmp_path)
    assert jobs["simulate"] == {f"Ref/Lobes_5/speed_{speed}.npz" for speed in (1000, 1100)}
    assert jobs["design_table"] == {"designs.csv"}
    assert jobs["design_figure"] == {"figures/designs_Lobes.png"}


def test_each_family_has_a_map_in_the_explorer():
    """Two families of the same keys, and one of a single key."""
    one = table_of([40.0, 30.0, 20.0, 0.0])
    other = one.assign(family="Other", scene=[f"Other_{number}" for number in range(4)], length_dangerous_rad_s=7.0)
    single = one.drop(columns=KEYS[1]).assign(family="Single")
    shown = contents(pd.concat([one, other, single]))
    assert [(family["family"], family["other"]) for family in shown] == [(name, "blade") for name in ("Room", "Other")]
    assert shown[1]["cells"][3] == ["Ref", "Other_3", 6e-4, 0.002]
    families = compared_in(pd.concat([one, other, single]))
    assert families["Single"].keys == KEYS[:1]
    assert families["Other"].scenes == tuple(other["scene"])
