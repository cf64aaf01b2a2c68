"""Contact length and moduli of a lining from the forces of a rub rig."""

from dataclasses import replace
from pathlib import Path

import contact_laws
import numpy as np
import pytest
import yaml
from refusal_tables import pattern_of, refusal_rows

import r37
from r37core.config import ConfigError
from r37core.contact.scene import Lining
from r37studies.measured.rub_tests.lining_fit import fit_lining
from r37studies.measured.rub_tests.rig_table import read_rub_test

SHIPPED = Lining(5e-3, 20e9, 5e9, 1.5)
HIDDEN = Lining(2e-3, 2e9, 6e8, 2e7, contact_length=3e-4)
TRUE = {"elastic_modulus_pa": 2e9, "plastic_modulus_pa": 6e8, "yield_stress_pa": 2e7, "tangent_modulus_pa": 6e8 / 1.3}
WIDTH, RAMP = 0.01, np.linspace(5e-6, 2e-4, 40)
RIG = {"width_m": WIDTH, "thickness_m": 2e-3}
TABLE = Path(__file__).with_name("refusals.txt")


def rig_forces(depths, lining):
    """Forces that the compiled law of the simulation gives for depths one after another."""
    wear, forces = 0.0, []
    for depth in depths:
        stress, wear = contact_laws.return_mapping(depth, wear, lining)
        forces.append(stress * WIDTH * lining.contact_length)
    return np.array(forces)


def points(depths, forces, thickness=2e-3, **columns):
    return read_rub_test({"depth_m": depths, "force_n": forces, **columns}, {"width": WIDTH, "thickness": thickness})


def test_the_law_of_the_simulation_gives_its_numbers_back():
    """Two thicknesses, each pressed and released on one place: every branch of the law."""
    depths = np.concatenate([RAMP, np.linspace(1.9e-4, 1e-4, 10)])
    thick = Lining(3e-3, 2e9, 6e8, 2e7, contact_length=3e-4)
    rig = {
        "depth_um": 1e6 * np.tile(depths, 2),
        "force_kn": 1e-3 * np.concatenate([rig_forces(depths, HIDDEN), rig_forces(depths, thick)]),
    }
    rig |= {"Thickness [mm]": np.repeat([2.0, 3.0], len(depths)), "Test": np.repeat(["a", "b"], len(depths)), "time_s": 0.0}
    fit = r37.lining_from_rub_test(rig, width_m=WIDTH, contact_length_m=3e-4)
    assert {name: value.best for name, value in fit.values.items()} == pytest.approx(TRUE, rel=1e-6)
    assert fit.unknown == () and fit.outliers == ()
    # any other split of the products has the same forces
    keys = r37.lining_from_rub_test(rig, width_m=WIDTH).scene["lining"]
    split = {"contact_length_m": 3e-5, "elastic_modulus_pa": 2e10, "plastic_modulus_pa": 6e9, "yield_stress_pa": 2e8}
    assert keys == pytest.approx(split, rel=1e-6)
    scene = r37.scene("material_abradable", **{f"lining.{key}": value for key, value in keys.items()}).entry.scene()
    split = rig_forces(depths, replace(scene.lining, thickness=2e-3))
    np.testing.assert_allclose(split, rig_forces(depths, HIDDEN), rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("has_rows_in_air", [True, False])
def test_air_before_the_first_touch_is_fitted_of_each_test(has_rows_in_air):
    """The strokes of two tests begin 50 and 20 um above the lining."""
    lining = replace(SHIPPED, thickness=2e-3, contact_length=1.6e-4)
    forces = rig_forces(RAMP, lining)
    strokes, pressed = [], []
    for air in (5e-5, 2e-5):
        before = np.linspace(0.0, air, 5) if has_rows_in_air else []
        strokes.append(np.append(before, RAMP + air))
        pressed.append(np.append(np.zeros(len(before)), forces))
    names = np.repeat(["a", "b"], [len(part) for part in strokes])
    fit = fit_lining(points(np.concatenate(strokes), np.concatenate(pressed), test=names), SHIPPED)
    assert fit.contact_length.best == pytest.approx(1.6e-4, rel=1e-3)
    assert fit.first_touch == pytest.approx({"a": 5e-5, "b": 2e-5}, abs=2e-7)


def test_forces_that_fall_with_depth_are_refused():
    with pytest.raises(ConfigError, match="forces that fall with depth"):
        points([1e-5, 2e-5, 3e-5, 4e-5], [40.0, 30.0, 20.0, 10.0])


@pytest.mark.slow
@pytest.mark.parametrize("relative", [True, False])
def test_ranges_of_95_percent_hold_the_hidden_numbers(relative):
    """Noise of 5%, of each force or of the largest one."""
    random, forces = np.random.default_rng(7), rig_forces(RAMP, HIDDEN)
    size = 0.05 * (forces if relative else forces.max())
    held = {name: 0 for name in TRUE}
    for _ in range(200):
        fit = fit_lining(points(RAMP, forces + size * random.standard_normal(len(RAMP))), SHIPPED, 3e-4)
        for name, true in TRUE.items():
            held[name] += fit.values[name].range_95[0] <= true <= fit.values[name].range_95[1]
    assert min(held.values()) >= 180
    assert max(held["plastic_modulus_pa"], held["tangent_modulus_pa"]) <= 198


@pytest.mark.slow
def test_a_line_through_the_origin_gives_a_contact_length_and_no_moduli():
    """It may be elastic or yield from the start; with the scene's moduli it is one number."""
    lining, depths = Lining(5e-3, 20e9, 5e9, 1.5, contact_length=2e-4), np.linspace(1e-5, 1e-3, 20)
    random, held = np.random.default_rng(3), 0
    for _ in range(100):
        noisy = rig_forces(depths, lining) * (1.0 + 0.05 * random.standard_normal(20))
        fit = fit_lining(points(depths, noisy, 5e-3), SHIPPED)
        held += fit.contact_length.range_95[0] <= 2e-4 <= fit.contact_length.range_95[1]
    assert 88 <= held <= 99
    assert fit.values["elastic_modulus_times_length_n_m"].range_95 == (0.0, np.inf)
    assert fit.values["tangent_modulus_times_length_n_m"].best == pytest.approx(2e-4 * 4e9, rel=0.1)
    assert fit.unknown[0].startswith("elastic_modulus and plastic_modulus apart")
    assert [*fit.scene["lining"]] == ["contact_length_m"]


@pytest.mark.parametrize(("depths", "forces"), [([0.1, 0.2], [40, 81]), ([0.01, 0.1, 0.2], [30, 90, 130])])
def test_two_or_three_points_have_no_ranges_of_moduli(depths, forces):
    """Only the contact length that goes with the scene's moduli has a range."""
    fit = r37.lining_from_rub_test({"depth_mm": depths, "force_n": forces}, **RIG)
    assert {value.range_95 for value in fit.values.values()} == {(0.0, np.inf)} and fit.unknown
    assert 0.0 < fit.contact_length.range_95[0] < fit.contact_length.best < fit.contact_length.range_95[1] < 1e-3


def test_an_outlier_is_named_and_left_out():
    forces = rig_forces(RAMP, HIDDEN) * (1.0 + 0.03 * np.random.default_rng(0).standard_normal(40))
    forces[24] *= 2.0
    fit = fit_lining(points(RAMP, forces), SHIPPED, 3e-4)
    assert fit.outliers == (25,)
    assert fit.values["tangent_modulus_pa"].best == pytest.approx(TRUE["tangent_modulus_pa"], rel=0.05)


@pytest.mark.parametrize(("power", "told"), [(0.0, False), (0.5, True)])
def test_speeds_that_disagree_are_told(power, told):
    speed = np.repeat([50.0, 100.0], 40)
    noise = 1.0 + 0.05 * np.random.default_rng(1).standard_normal(80)
    forces = np.tile(rig_forces(RAMP, HIDDEN), 2) * (speed / 50.0) ** power * noise
    unknown = fit_lining(points(np.tile(RAMP, 2), forces, speed_m_s=speed), SHIPPED).unknown
    assert any(text.startswith("speed: forces have a further power 0.") for text in unknown) == told


def test_a_table_has_the_separator_of_its_header(tmp_path):
    (tmp_path / "rig.csv").write_text("Depth (\u00b5m); Force [kN]\n100; .04\n200;.081\n")
    tables = (tmp_path / "rig.csv", {"depth_mm": [0.1, 0.2], "force_n": [40, 81]})
    of_file, of_columns = (r37.lining_from_rub_test(table, **RIG).contact_length.best for table in tables)
    assert of_file == pytest.approx(of_columns, rel=1e-9)


@pytest.mark.parametrize(("kind", "text", "message"), refusal_rows(TABLE, "rub tests"))
def test_a_table_that_fits_nothing_is_refused(tmp_path, kind, text, message):
    file = tmp_path / "rig.csv"
    file.write_text(text.replace(" / ", "\n"))
    with pytest.raises(r37.ConfigError, match=f"^{file}: .*{pattern_of(message)}"):
        r37.lining_from_rub_test(file, **RIG)


@pytest.mark.parametrize(("kind", "arguments", "message"), refusal_rows(TABLE, "arguments of a rub test"))
def test_arguments_that_fit_nothing_are_refused(kind, arguments, message):
    with pytest.raises(r37.ConfigError, match=pattern_of(message)):
        r37.lining_from_rub_test({"depth_mm": [0.1, 0.2], "force_n": [40, 81]}, **(RIG | yaml.safe_load(arguments)))
