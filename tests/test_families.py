"""Families of designs: many blades of one entry, their names, refusals, and how they are compared."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from r37core.base.plain import to_plain
from r37core.config import ConfigError
from r37core.config.families import design_name
from r37core.designs.compared import Compared
from r37core.designs.figures import draw_designs
from r37core.designs.plan import Families
from r37core.designs.table import MEASURES, design_table
from r37core.plans.sweep_plan import Sweep
from r37core.product.reporting import FIGURES, drawing
from r37core.product.targets import targets
from r37core.results.columns import names
from r37core.run_ups.plan import RunUps
from r37core.time_integration.status import RunStatus

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
    assert parameters["caption"]({"scene": "direct"}).endswith("diverged. 7 of 102 blades are drawn.")


def test_a_grid_has_every_value_with_every_other(with_blades):
    settings = with_blades(GRID)
    names = ["Grid_-2p5_8000", "Grid_-2p5_4500", "Grid_5_8000", "Grid_5_4500"]
    assert list(Families(settings).families["blade"]["Grid"].designs) == names
    assert settings.blades["Grid_5_4500"].material.density == 4500.0
    assert settings.blades["Grid_5_4500"].material.youngs_modulus == 180e9
    assert settings.blades["Grid_-2p5_8000"].definition.chordwise_sweep_angle == pytest.approx(np.radians(-2.5))


def test_pairs_go_side_by_side(with_blades):
    assert list(with_blades(GRID + "  combine: pairs\n", blades=["Grid"]).blades) == ["Grid_-2p5_8000", "Grid_5_4500"]


def test_a_table_has_one_design_a_row(with_blades):
    table = "blade,chordwise_sweep_deg,material.density_kg_m3\nForward,5,8000\nBack-1,-5,7.5e3\n"
    settings = with_blades("Mine: { base: Ref, designs: config/designs.csv }\n", table, blades=["Mine", "Ref"])
    assert list(settings.blades) == ["Forward", "Back-1", "Ref"]
    assert Families(settings).families["blade"]["Mine"].designs == {"Forward": (5.0, 8000.0), "Back-1": (-5.0, 7500.0)}
    assert settings.blades["Back-1"].material.density == 7500.0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (GRID.replace("[8000, 4500]", "[8000]") + "  combine: pairs\n", r"yaml:\d+: Grid\.vary: found chordwise_sweep_deg 2"),
        (GRID.replace("5]", "70]"), r"Grid\.chordwise_sweep_deg: design Grid_70_8000: found 70; allowed: .*than 60"),
        (GRID.replace("chordwise_sweep_deg", "sweep"), r"found unknown key sweep; .* \(did you mean sweep_percent\?\)"),
        (GRID.replace("chordwise_sweep_deg", "casing.lobes"), r"unknown key casing\.lobes; .*varies in scenes\.yaml"),
        (GRID.replace("[-2.5, 5]", "[5, 5]"), r"Grid\.vary\.chordwise_sweep_deg\.1: found 5\.0 twice; allowed: each once"),
        (SWEEP.replace("S100", "Ref"), r"yaml:\d+: Sweep_-50\.sweep_percent: .* no table of sweep and lean"),
        (SWEEP.replace("-50, stop: 150", "150, stop: -50"), r"percent\.stop: found -50; allowed: not below start \(150\)"),
        (SWEEP.replace("sweep_percent", "sweep_lean.1.sweep_cm"), r"Sweep\.sweep_lean: design Sweep_-50: found \{'1'"),
        (SWEEP + "More: { base: Sweep }\n", r"More\.base: found 'Sweep'; allowed: another blade"),
        (SWEEP + "Sweep_50: { base: Ref }\n", r"Sweep: found the design 'Sweep_50'; allowed: designs that are not"),
        (SWEEP + "  designs: config/designs.csv\n", r"Sweep: found both vary and designs; allowed: one of them"),
        ("Mine: { base: Ref, designs: config/none.csv }\n", r"yaml:\d+: Mine\.designs: there is no file config/none\.csv"),
    ],
)  # fmt: skip
def test_family_refusals(with_blades, text, message):
    with pytest.raises(ConfigError, match=message):
        with_blades(text)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("blade,chordwise_sweep_deg\nA,x\n", r"csv: family Mine: line 2, column chordwise_sweep_deg: 'x' is not"),
        (f"blade,chordwise_sweep_deg\nA,{'1' * 131_073}\n", r"csv: family Mine: line 1: not readable as a table"),
        ("blade,chordwise_sweep_deg\nA,1\nA,2\n", r"designs\.csv: family Mine: the blade 'A' is given twice"),
        ("chordwise_sweep_deg\n1\n", r"family Mine: line 1: the table lacks the columns blade"),
        ("blade,chordwise_sweep_deg\n" + "".join(f"A{n},1\n" for n in range(10_001)), "Mine.*: found 10001 designs"),
        ("blade,chordwise_sweep_deg\n", r"family Mine: the table has no designs"),
        ("blade,chordwise_sweep_deg\nA__b,1\n", r"yaml:\d+: Mine: found 'A__b'; allowed: a name of letters"),
        ("blade,chordwise_sweep_deg\nRef,1\n", r"Mine: found the design 'Ref'; allowed: designs that are not named like"),
    ],
)  # fmt: skip
def test_table_refusals(with_blades, table, message):
    with pytest.raises(ConfigError, match=message):
        with_blades("Mine: { base: Ref, designs: config/designs.csv }\n", table)


@pytest.fixture
def compared():
    """Two designs in a scene with stress and one without."""
    campbell = xr.Dataset(
        {
            "frequency": (("blade", "mode", "speed"), [[[800.0, 900.0], [2500.0, 2600.0]], [[700.0, 800.0], [2400.0, 2500.0]]]),
            "dynamic_clearance": (("blade", "mode", "tangential_displacement"), [[[-3e-4, 1e-4]] * 2, [[-2e-4, 1e-4]] * 2]),
        },
        coords={"blade": ["F_1", "F_2"], "mode": ["1B", "1T"], "speed": [0.0, 2000.0]},
    )
    over = ("blade", "scene", "speed")
    largest = (over, [[[1e9, 3e9, np.nan]], [[1e9, 1e9, 1e9]]])
    stress = xr.Dataset(
        {
            **dict.fromkeys(("max_von_mises", "max_von_mises_median", "max_von_mises_ever"), largest),
            "share_of_revolutions_above_yield": (over, [[[0.0, 1.0, np.nan]], [[0.0, 0.0, 0.0]]]),
            "yield_stress": (("blade", "scene"), [[2e9], [2e9]]),
            "status": (("blade", "scene", "speed"), [[[0, 0, RunStatus.NOT_RUN]], [[0, 0, 0]]]),
        },
        coords={"blade": ["F_1", "F_2"], "scene": ["lined"], "speed": [900.0, 910.0, 920.0]},
    )
    interactions = pd.DataFrame(
        [("F_1", "lined", "1B", 1e-3, 30.0), ("F_1", "lined", "1B", 5e-3, 50.0), ("F_1", "lined", np.nan, 9e-3, np.nan)],
        columns=["blade", "scene", "mode", "peak_rms_tangential_m", "shift_rad_s"],
    )
    motion = ((*over, "tip_point"), np.full((2, 2, 3, 2), 1e-3))
    rms = xr.Dataset(
        {"rms_normal": motion, "rms_tangential": motion, "status": (over, np.zeros((2, 2, 3)))},
        coords={**stress.coords, "scene": ["lined", "bare"], "tip_point": ["leading_edge", "trailing_edge"]},
    )
    rms["status"][0, :, 2] = RunStatus.NOT_RUN
    variables = {"blade": {"F_1": {"sweep_percent": 1.0}, "F_2": {"sweep_percent": 2.0}}, "scene": {}}
    datasets = {"campbell": campbell, "rms": rms, "stress": stress}
    pairs = [(blade, scene) for blade in ("F_1", "F_2") for scene in ("lined", "bare")]
    families = {"blade": {"F_1": "F", "F_2": "F"}, "scene": {}}
    return design_table(pairs, variables, families, {"F_1": 0.2, "F_2": 0.3}, datasets, interactions)


def test_designs_are_compared(compared):
    assert list(compared.columns) == ["blade", "scene", "family", "sweep_percent", *names(MEASURES)]
    rows = compared.set_index(["blade", "scene"])
    one = rows.loc["F_1", "lined"]
    assert (one["mass_kg"], one["frequency_1b_hz"], one["frequency_1t_hz"]) == (0.2, 800.0, 2500.0)
    assert one["clearance_loss_1b_m"] == 3e-4
    keys = ["length_most_revolutions_rad_s", "first_most_revolutions_rad_s", "largest_median_stress_pa"]
    assert one[keys].tolist() == [5.0, 905.0, 3e9]
    # of the two peaks of 1B the one with the larger motion
    assert one["shift_1b_rad_s"] == 50.0
    other = rows.loc["F_2", "lined"]
    assert other["length_most_revolutions_rad_s"] == other["length_some_revolutions_rad_s"] == 0.0
    assert np.isnan(other["first_most_revolutions_rad_s"])
    assert np.isnan(other["shift_1b_rad_s"])
    assert np.isnan(rows.loc["F_1", "bare"]["largest_median_stress_pa"])


def test_a_family_is_drawn(compared):
    names = (("F_1", "F_2"), ("lined", "bare"))
    figure = draw_designs("F", compared, to_plain(Compared("blade", ("sweep_percent",), *names)))
    assert len(figure.axes) == 9
    assert list(figure.axes[0].lines[0].get_xdata()) == [1.0, 2.0]
    figure = draw_designs("F", compared.assign(other=0.0), to_plain(Compared("blade", ("sweep_percent", "other"), *names)))
    assert [label.get_text() for label in figure.axes[6].get_xticklabels()] == ["F_1", "F_2"]
