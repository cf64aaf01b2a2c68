"""Several mistakes are told at once: each on a line of its own, once, and none that follows from another."""

import pytest
from test_refusals import CONFIG_REFUSALS, edit

from r37core.config import ConfigError, command_line_document
from r37core.config.document import ConfigRefusals
from r37core.product.reading import read_settings


def told(folder, **changes):
    """Lines of the refusal of a configuration."""
    with pytest.raises(ConfigError) as refused:
        read_settings(folder, command_line_document(changes))
    return str(refused.value).splitlines()


def starts(lines, *expected):
    assert [line[: len(start)] for line, start in zip(lines, expected, strict=True)] == list(expected)


def test_mistakes_in_three_files(config_copy):
    edit(config_copy / "config/config.yaml", "tolerance: 0.05", "tolerance: 5")
    edit(config_copy / "config/blades.yaml", "density_kg_m3: 8000", "density_kg_m3: 0")
    edit(config_copy / "config/scenes.yaml", "lobes: 2", "lobes: -2")
    lines = told(config_copy)
    starts(lines, "config/config.yaml:", "config/blades.yaml:", "config/scenes.yaml:")
    assert lines[0].endswith("tolerance: found 5; allowed: number, at least 1e-06, at most 1")
    assert lines[1].endswith("Ref.material.density_kg_m3: found 0.0; allowed: number, at least 1, at most 100000")
    assert lines[2].endswith(".casing.lobes: found -2; allowed: integer, at least 0, at most 100")


def test_three_mistakes_in_one_file(config_copy):
    lines = told(config_copy, tolerance=5, campbell={"modes": 99}, interaction={})
    starts(
        lines, "--config: top level: found unknown key", "--config: tolerance: found 5", "--config: campbell.modes: found 99"
    )


def test_a_missing_key_beside_an_unknown_one_is_not_told(config_copy):
    """The unknown one may be meant for it."""
    edit(config_copy / "config/scenes.yaml", "coefficient: 0.15", "coeficient: 0.15")
    (line,) = told(config_copy)
    assert "found unknown key coeficient" in line
    assert line.endswith("(did you mean coefficient?)")


def test_names_that_are_not_there_are_told_once_each(config_copy):
    """Nearly every other check looks them up."""
    lines = told(config_copy, fidelity="finest", blades=["Reff"], scenes=["wet"])
    starts(
        lines,
        "--config: fidelity: found 'finest'; allowed: draft, standard",
        "--config: blades: found 'Reff'; allowed: Ref, L50",
        "--config: scenes: found 'wet'; allowed: abradable, direct",
    )


def test_mistakes_of_the_pipeline_and_of_extensions(config_copy):
    run_ups = {"a": {"from_rad_s": 900, "to_rad_s": 2100, "revolutions": 5}, "b": {"blades": ["Reff"]}}
    run_ups["b"] |= run_ups["a"]
    lines = told(config_copy, speeds=[900, 900], run_ups=run_ups, signals={"speeds_rad_s": [900], "blades": ["Reff"]})
    starts(
        lines,
        "--config: speeds: found 900 rad/s twice",
        "--config: signals.blades: found 'Reff'",
        "--config: run_ups.a.revolutions: found 2100 rad/s",
        "--config: run_ups.b.blades: found 'Reff'",
    )


def test_mistakes_in_one_section(config_copy):
    rules = [{"blades": ["Reff"], "scenes": ["wet"], "speeds": [900]}, {"scenes": ["dry"], "speeds": [900]}]
    stability = {"base": "rough", "scenes": ["wet"]}
    lines = told(config_copy, speeds_for=rules, stability=stability)
    places = "speeds_for.0.blades speeds_for.0.scenes speeds_for.1.scenes stability.base stability.scenes"
    assert sorted(line.split(":")[1].strip() for line in lines) == places.split()


@pytest.mark.parametrize("text", [new for old, new, _ in CONFIG_REFUSALS if old == "exports: #"][::5])
def test_no_check_stumbles_over_what_another_has_refused(config_copy, text):
    edit(config_copy / "config/config.yaml", "exports: #", text)
    lines = told(config_copy, blades=["Reff"], scenes=["wet"], fidelity="finest")
    assert len(set(lines)) == len(lines)
    assert all(": found " in line or ": missing key " in line for line in lines)


def test_a_table_that_many_blades_share_is_told_of_once(config_copy):
    edit(config_copy / "config/profiles/rotor37.csv", "58.470", "abc")
    add = "\nOther: { base: Ref, chordwise_sweep_deg: 5, material: { yield_stress_pa: 1e9 }, stacking_table: none.csv }\n"
    (config_copy / "config/blades.yaml").write_text((config_copy / "config/blades.yaml").read_text() + add)
    lines = told(config_copy)
    assert len(lines) == 1
    edit(config_copy / "config/blades.yaml", " chordwise_sweep_deg: 5,", "")
    (line,) = told(config_copy)
    assert "rotor37.csv:6" in line or "line 6" in line
    edit(config_copy / "config/profiles/rotor37.csv", "abc", "58.470")
    (line,) = told(config_copy)
    assert "Other.stacking_table: there is no file none.csv" in line


def test_not_more_is_told_than_anybody_reads(config_copy):
    def refuse(number):
        raise ConfigError(f"mistake {number}")

    refusals = ConfigRefusals()
    for number in [*range(30), *range(30)]:
        refusals.of(refuse, number)
    with pytest.raises(ConfigError) as refused:
        refusals.tell()
    lines = str(refused.value).splitlines()
    assert (lines[0], lines[-1], len(lines)) == ("mistake 0", "and 10 more", 21)
    ConfigRefusals().tell()
