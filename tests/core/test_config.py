"""Configuration: what is accepted, schemas for editors, and what the refusals say, of several mistakes at once, too."""

import subprocess
import sys

import pytest
import yaml
from refusal_tables import pattern_of, refusal_rows
from test_refusals import TABLE, edit
from workflow_runs import overlay

from r37core.base.yaml_file import load_yaml
from r37core.config import ConfigError, command_line_document, read_document
from r37core.config.document import ConfigRefusals
from r37core.config.remarks import remarks_of_pipeline, remarks_on_laws
from r37core.plans.provenance import structure_hash
from r37core.product.extensions import load_settings, read_settings


def load(folder, **changes):
    return load_settings(load_yaml(folder / "config/config.yaml") | changes, folder)


def regions(**changes):
    return {"structure": {"stress_regions": changes}}


def test_the_box_is_of_the_benchmark_and_its_variants(config_copy):
    """A blade of one's own has the regions of config.yaml, a variant may have others; null leaves one out of all blades."""
    text = (config_copy / "config/blades.yaml").read_text()
    material = "{ youngs_modulus_pa: 1.8e+11, density_kg_m3: 8000, poissons_ratio: 0.3, yield_stress_pa: 1.38e+9 }"
    text += (
        f"Mine: {{ profiles: config/profiles/rotor37.csv, material: {material} }}\nVariant: {{ base: S50, stagger_deg: 1 }}\n"
    )
    text += "Other: { base: Variant, stress_regions: { foot: { maximum_span: 0.1 } } }\n"
    (config_copy / "config/blades.yaml").write_text(text)
    more = {"Ref": ["box"], "CS100": ["box"], "Variant": ["box"], "Mine": [], "Other": ["foot"]}
    found = load(config_copy)
    assert {name: list(found.stress_regions(name))[2:] for name in more} == more
    left_out = load(config_copy, **regions(airfoil={"minimum_span": 0.1}, box=None))
    assert list(left_out.stress_regions("Variant")) == ["airfoil"]


@pytest.mark.parametrize(("name", "change", "message"), refusal_rows(TABLE, "rotor37.csv"))
def test_profile_table_refusals(config_copy, name, change, message):
    edit(config_copy / "config/profiles" / name, *change.split(" -> "))
    with pytest.raises(ConfigError, match=pattern_of(message)):
        load(config_copy)


def test_structure_hash_follows_what_the_blade_depends_on(with_blades, config_copy):
    before = load(config_copy)
    assert structure_hash(load(config_copy, blades=["Ref"]), "Ref") == structure_hash(before, "Ref")
    with open(config_copy / "config/stacking/rotor37.csv", "a") as stream:
        stream.write("New,0,0,0\nNew,100,0.1,0\n")
    extended = with_blades("New: {base: Ref, stacking_table: config/stacking/rotor37.csv}")
    assert structure_hash(extended, "L50") == structure_hash(before, "L50")
    edit(config_copy / "config/profiles/rotor37.csv", "17.780", "17.781")
    assert structure_hash(load(config_copy), "Ref") != structure_hash(before, "Ref")


@pytest.mark.parametrize(
    ("scene", "changes", "said"),
    [
        ("physical_direct", {"friction": {"coefficient": 0.2}}, None),
        ("physical_direct", {"friction": {"coefficient": 0.25}}, "friction.coefficient is 0.25; above 0.2 exact_modal and"),
        # both integrators agree on a lining
        ("physical_abradable", {"friction": {"coefficient": 0.6}}, None),
        ("physical_abradable", {"lining": {"plastic_modulus_pa": 1.0e3}}, None),
        ("physical_abradable", {"lining": {"plastic_modulus_pa": 0}}, "lining.plastic_modulus_pa is 0: bars do not harden"),
    ],
)
def test_laws_beyond_what_a_run_can_bear_are_remarked_on(config_copy, scene, changes, said):
    """Scenes that are not run say nothing."""
    others = {name: {"friction": {"coefficient": 5}} for name in {"physical_direct", "elastic_direct"} - {scene}}
    overlay(config_copy, "scenes.yaml", yaml.safe_dump({scene: changes, **others}))
    overlay(config_copy, "config.yaml", f"scenes: [{scene}]")
    remarks = [*remarks_on_laws(read_settings(config_copy))]
    begins = f"scene '{scene}': {said}"
    assert [remark[: len(begins)] for remark in remarks] == ([begins] if said else [])
    assert set(remarks) <= set(remarks_of_pipeline(read_settings(config_copy)))


def test_a_message_points_into_the_file_that_said_it_and_changes_keep_what_they_do_not_name(config_copy):
    (config_copy / "mine.yaml").write_text("# mine\n\nstructure:\n  boundary:\n    nodes: 0\n")
    with pytest.raises(ConfigError, match=r"^mine\.yaml:5: structure\.boundary\.nodes: found 0"):
        read_settings(config_copy, read_document(config_copy, "mine.yaml"))
    with pytest.raises(ConfigError, match=r"^--config: structure\.boundary\.nodes: found 0"):
        read_settings(config_copy, command_line_document({"structure": {"boundary": {"nodes": "0"}}}))
    settings = read_settings(config_copy, command_line_document({"structure": {"boundary": {"nodes": "4"}}}))
    assert (settings.structure.boundary.nodes, settings.structure.boundary.tip_line) == (4, "pressure_edge")


IMPORTED = {
    # by what forks for each of thousands of jobs
    "import r37core.console.fork_server, r37core.time_integration.speed_job": {"pydantic", "yaml", "netCDF4", "xarray"},
    # by every Snakemake, before ours sets the number of threads
    "import snakemake_executor_plugin_warm": {"numpy", "yaml"},
    "import r37core.base.plain": {"numpy", "pydantic", "yaml"},
    # a word of the command that computes nothing
    "import r37.command": {"numpy", "pydantic", "scipy", "xarray"},
    # it takes half a second at every start of Snakemake, and a plan builds no blade
    "import r37core.config, r37core.plans.sweep_plan": {"scipy.optimize", "scipy.interpolate"},
}
"""Imports -> what they must not bring along."""


@pytest.mark.parametrize("imports", IMPORTED)
def test_what_starts_often_is_light(imports):
    code = f"import sys\n{imports}\nprint({IMPORTED[imports]} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "set()\n"


def told(folder, **changes):
    """Lines of the refusal of a configuration."""
    with pytest.raises(ConfigError) as refused:
        read_settings(folder, command_line_document(changes))
    return str(refused.value).splitlines()


def starts(lines, *expected, where="--config: "):
    expected = [f"{where}{start}" for start in expected]
    assert [line[: len(start)] for line, start in zip(lines, expected, strict=True)] == expected


def test_mistakes_in_one_file_are_told_once_each(config_copy):
    """In it, among names, which nearly every other check looks up, in extensions, and in one section."""
    lines = told(config_copy, fidelity=5, campbell={"modes": 99}, interaction={})
    starts(lines, "top level: found unknown key", "fidelity: found 5", "campbell.modes: found 99")
    lines = told(config_copy, fidelity="finest", blades=["Reff"], scenes=["wet"])
    fidelity = "fidelity: found 'finest'; allowed: draft, standard"
    starts(lines, fidelity, "blades: found 'Reff'; allowed: Ref, L50", "scenes: found 'wet'; allowed: abradable, direct")
    lines = told(config_copy, speeds=[900, 900], scenes=["direct"])
    starts(lines, "speeds: found 900 rad/s twice")
    rules = [{"blades": ["Reff"], "scenes": ["wet"], "speeds": [900]}, {"scenes": ["dry"], "speeds": [900]}]
    lines = told(config_copy, speeds_for=rules)
    assert sorted(line.split(":")[1].strip() for line in lines) == [
        f"speeds_for.{row}" for row in ("0.blades", "0.scenes", "1.scenes")
    ]


def test_a_missing_key_beside_an_unknown_one_is_not_told(config_copy):
    """The unknown one may be meant for it."""
    edit(config_copy / "config/scenes.yaml", "coefficient: 0.15", "coeficient: 0.15")
    (line,) = told(config_copy)
    assert "found unknown key coeficient" in line
    assert line.endswith("(did you mean coefficient?)")


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
    assert "Other.stacking_table: there is no file config/none.csv" in line


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
