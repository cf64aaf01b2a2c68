"""Families of scenes: many scenes of one entry, their names, refusals, and how designs of both kinds are compared."""

import numpy as np
import pandas as pd
import pytest
from overlays import overlay
from plans_of_snakemake import planned_outputs
from stubbed_runs import copy_stubbed
from workflow_runs import snakemake

import r37
from r37 import studies
from r37core.base.plain import to_plain
from r37core.config import ConfigError, command_line_document
from r37core.designs.compared import Compared
from r37core.designs.maps import draw_design_map
from r37core.designs.panel import contents
from r37core.designs.plan import EXTENSION, Families
from r37core.designs.table import compared_in
from r37core.plans.sweep_plan import Sweep
from r37core.product.reading import read_settings
from r37core.product.targets import targets as all_targets

CASING = "casing: { clearance_m: 4.0e-4, lobes: 2, width: 0.15, amplitude_m: 7.0e-4 }"
LINING = "lining: { thickness_m: 0.005, elastic_modulus_pa: 2.0e+10, plastic_modulus_pa: 5.0e+9, yield_stress_pa: 1.5 }"
ROOM = (
    f"Room:\n  {CASING}\n  {LINING}\n  results: [stress, wear]\n  friction: {{ coefficient: 0.15 }}\n"
    "  vary:\n    casing.clearance_m: [3.0e-4, 6.0e-4]\n    lining.thickness_m: [0.001, 0.002, 0.005]\n"
)
LOBES = f"Lobes:\n  {CASING}\n  vary: {{ casing.lobes: [2, 3] }}\n"
SWEEP = "Sweep: { base: S100, vary: { sweep_percent: [50, 100] } }"


@pytest.fixture
def with_scenes(config_copy):
    def read(text, table="", **changes):
        with open(config_copy / "config/scenes.yaml", "a") as stream:
            stream.write(f"\n{text}\n")
        (config_copy / "config/rooms.csv").write_text(table)
        return read_settings(config_copy, command_line_document(changes))

    return read


def test_a_grid_of_scenes(with_scenes):
    settings = with_scenes(ROOM, scenes=["Room", "direct"], blades=["Ref"])
    assert settings.scene_names == [f"Room_{c}_{t}" for c in ("0p0003", "0p0006") for t in ("0p001", "0p002", "0p005")] + [
        "direct"
    ]
    scene = settings.scenes["Room_0p0006_0p002"].scene
    assert (scene.casing.clearance, scene.casing.lobe_height, scene.lining.thickness) == (6e-4, 7e-4, 0.002)
    assert scene.lining.plastic_modulus == 5e9


def test_a_whole_number_stays_one(with_scenes):
    settings = with_scenes(LOBES, scenes=["Lobes"], blades=["Ref"])
    assert [chosen.scene.casing.lobes for chosen in settings.scenes.values()] == [2, 3]


def test_a_whole_number_that_the_scene_does_not_write(with_scenes):
    settings = with_scenes(f"Long: {{ {CASING}, vary: {{ revolutions: [20, 40] }} }}", scenes=["Long"], blades=["Ref"])
    assert [chosen.revolutions for chosen in settings.scenes.values()] == [20, 40]


def test_ranges_of_small_numbers_keep_their_values(with_scenes):
    vary = "vary: { lining.bar_area_m2: { start: 2.4e-9, stop: 3.6e-9, step: 4.0e-10 } }"
    settings = with_scenes(f"Bars:\n  {CASING}\n  {LINING}\n  {vary}\n", scenes=["Bars"], blades=["Ref"])
    assert list(settings.scene_designs.families["Bars"].designs.values()) == [(2.4e-9,), (2.8e-9,), (3.2e-9,), (3.6e-9,)]


def test_a_table_of_scenes(with_scenes):
    table = "scene,casing.clearance_m,damping_ratio\nTight,3e-4,0.001\nWide,8e-4,0.002\n"
    settings = with_scenes(f"Room: {{ {CASING}, designs: config/rooms.csv }}", table, scenes=["Room"], blades=["Ref"])
    assert {name: chosen.scene.damping_ratio for name, chosen in settings.scenes.items()} == {"Tight": 0.001, "Wide": 0.002}


def test_sections_name_families_of_scenes(with_scenes):
    settings = with_scenes(
        ROOM,
        scenes=["Room", "direct"],
        blades=["Ref"],
        speeds_for=[{"scenes": ["Room"], "speeds": [1150.0]}],
        tolerances={"scenes": ["Room"], "members": 2, "of_scenes": {"friction.coefficient": {"uniform_percent": 5}}},
        run_ups={"up": {"from_rad_s": 1100, "to_rad_s": 1110, "rate_rad_s2": 100, "scenes": ["Room"]}},
    )
    plans = settings.speed_plans
    assert {scene for (_, scene), plan in plans.items() if list(plan.certain) == [1150.0]} == set(settings.scene_names) - {
        "direct"
    }


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (ROOM.replace("thickness_m: [", "thickness: ["), r"Room.*found unknown key"),
        (ROOM.replace("casing.clearance_m: [3.0e-4", "casing.clearance_m: [-3.0e-4"), r"Room.*-0\.0003"),
        (ROOM.replace("lining.thickness_m: [", "sweep_percent: ["), r"found unknown key sweep_percent; .*blades\.yaml"),
        (ROOM + "  designs: config/rooms.csv\n", "both vary and designs"),
        (ROOM + f"room_0P0003_0p001: {{ {CASING} }}\n", "differ in more than capitals"),
        (ROOM + f"Room_0p0003_0p001: {{ {CASING} }}\n", "not named like another scene"),
    ],
)
def test_scene_family_refusals(with_scenes, text, message):
    with pytest.raises(ConfigError, match=message):
        with_scenes(text, scenes=["Room"])


def test_a_family_of_scenes_is_not_called_like_one_of_blades(with_scenes, config_copy):
    with open(config_copy / "config/blades.yaml", "a") as stream:
        stream.write(f"\n{SWEEP.replace('Sweep', 'Room')}\n")
    with pytest.raises(ConfigError, match=r"scenes\.yaml.*'Room', which is a family of blades"):
        with_scenes(ROOM)


def test_what_is_compared_and_drawn(with_scenes, config_copy):
    with open(config_copy / "config/blades.yaml", "a") as stream:
        stream.write(f"\n{SWEEP}\n")
    settings = with_scenes(ROOM + LOBES, scenes=["Room", "Lobes", "direct"], blades=["Sweep", "Ref"])
    families = Families(settings)
    assert families.variables["scene"]["Room_0p0006_0p002"] == {
        "scene.casing.clearance_m": 6e-4,
        "scene.lining.thickness_m": 0.002,
    }
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


def test_designs_have_no_figures_of_their_own(with_scenes):
    settings = with_scenes(ROOM, scenes=["Room", "direct"], blades=["Ref"])
    files = all_targets(Sweep(settings))
    assert [names["scene"] for names in files["<results>/figures/comparison_{scene}.png"]] == ["direct"]
    alone = Sweep(with_scenes("", scenes=["Room"], blades=["Ref"]))
    assert alone.drawn["scene"] == alone.settings.scene_names


KEYS = ("scene.casing.clearance_m", "scene.lining.thickness_m")


def table_of(lengths):
    """Lengths above yield over two clearances and two thicknesses, of one blade."""
    places = [(clearance, thickness) for clearance in (3e-4, 6e-4) for thickness in (0.001, 0.002)]
    rows = [("Ref", f"Room_{number}", "Room", *place) for number, place in enumerate(places)]
    return pd.DataFrame(rows, columns=["blade", "scene", "family", *KEYS]).assign(length_certain_rad_s=lengths)


def test_a_map_has_values_in_place_and_the_line_of_a_requirement():
    table = table_of([40.0, 30.0, 20.0, 0.0])
    verdict = table[["blade", "scene"]].assign(
        requirement="above_yield", verdict=["fails", "fails", "fails", "meets"], margin=[-30.0, -20.0, -10.0, 10.0]
    )
    (compared,) = compared_in(table).values()
    assert compared == Compared(
        "scene", ("scene.casing.clearance_m", "scene.lining.thickness_m"), ("Ref",), tuple(table["scene"])
    )
    figure = draw_design_map("Room", table, to_plain(compared), verdict)
    axes = figure.axes[0]
    np.testing.assert_array_equal(axes.collections[0].get_array().reshape(2, 2), [[40.0, 20.0], [30.0, 0.0]])
    marks = [line for line in axes.lines if line.get_label() == "meets all requirements"]
    assert (list(marks[0].get_xdata()), list(marks[0].get_ydata())) == ([1], [0.7])
    (limit,) = [collection for collection in axes.collections[1:] if collection.get_label() == "limit: above_yield"]
    # round the design that meets it
    assert sorted(segment.tolist() for segment in limit.get_segments()) == [[[0.5, 0.5], [0.5, 1.5]], [[0.5, 0.5], [1.5, 0.5]]]
    assert [text.get_text() for text in axes.texts] == ["40", "20", "30", "0"]
    assert axes.get_xlabel() == "scene.casing.clearance (mm)"


@pytest.mark.slow
def test_one_more_value_runs_its_own_simulations(root, tmp_path):
    copy_stubbed(root, tmp_path)
    overlay(tmp_path, "config.yaml", "blades: [Ref]\nscenes: [Lobes]\nspeeds: [1000, 1100]")
    overlay(tmp_path, "scenes.yaml", LOBES)
    snakemake(tmp_path, "all_blades", "--cores", "2")
    overlay(tmp_path, "scenes.yaml", LOBES.replace("[2, 3]", "[2, 3, 5]"))
    jobs = planned_outputs(tmp_path)
    assert jobs["simulate"] == {f"Ref/Lobes_5/speed_{speed}.npz" for speed in (1000, 1100)}
    assert jobs["design_table"] == {"designs.csv"}
    assert jobs["design_figure"] == {"figures/designs_Lobes.png"}


def test_a_limit_goes_round_designs_and_not_round_holes():
    table = table_of([40.0, 30.0, 20.0, 0.0]).iloc[[0, 3]]
    verdict = table[["blade", "scene"]].assign(requirement="mass", verdict="meets", margin=1.0)
    (compared,) = compared_in(table).values()
    axes = draw_design_map("Room", table, to_plain(compared), verdict).axes[0]
    assert not [collection for collection in axes.collections if str(collection.get_label()).startswith("limit")]


def test_each_family_has_a_map_in_the_explorer():
    """Two families of the same keys, and one of a single key."""
    one = table_of([40.0, 30.0, 20.0, 0.0])
    other = one.assign(family="Other", scene=[f"Other_{number}" for number in range(4)], length_certain_rad_s=7.0)
    single = one.drop(columns=KEYS[1]).assign(family="Single")
    shown = contents(pd.concat([one, other, single]))
    assert [(family["family"], family["keys"], family["other"]) for family in shown] == [
        ("Room", list(KEYS), "blade"),
        ("Other", list(KEYS), "blade"),
    ]
    assert shown[1]["cells"][3] == ["Ref", "Other_3", 6e-4, 0.002]
    assert shown[1]["values"]["shape"] == [4]
    families = compared_in(pd.concat([one, other, single]))
    assert families["Single"].keys == KEYS[:1]
    assert families["Other"].scenes == tuple(other["scene"])


def test_designs_of_scenes_from_python(monkeypatch):
    """Each scene is a family of its own; without keys of the blade that is as it is."""
    asked = []
    monkeypatch.setattr(studies, "run_of", lambda call, options: asked.append((call.blades, call.scenes)))
    r37.designs("Ref", ["abradable", "direct"], [1150], vary={"scene.casing.clearance_m": [3e-4, 4e-4]})
    r37.designs("S100", "direct", [1150], vary={"scene.damping_ratio": [0.001], "sweep_percent": [50, 100]})
    ((blades, scenes), (families, others)) = asked
    assert [blade.name for blade in blades] == ["Ref"]
    assert [scene.name for scene in scenes] == ["abradable-varied", "direct-varied"]
    assert scenes[1].changes["vary"] == {"casing.clearance_m": [3e-4, 4e-4]}
    assert (families[0].name, families[0].changes["vary"]) == ("Design", {"sweep_percent": [50, 100]})
    assert others[0].base == "direct"
