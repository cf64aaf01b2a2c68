"""Blades of other programs in the configuration, and the plans of their rules."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import yaml
from box_mesh import write_deck
from import_defaults import Where, refused
from refusal_tables import pattern_of, refusal_rows
from workflow_runs import overlay

from r37core.config import ConfigError
from r37core.figures.declared import FIGURES
from r37core.plans.provenance import structure_hash
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.product.targets import targets

MATERIAL = {"youngs_modulus_pa": 115e9, "density_kg_m3": 4430.0, "poissons_ratio": 0.32, "yield_stress_pa": 9e8}
AXES = {"length_unit": "mm", "rotor_axis": [1, 0, 0], "radial": [0, 0, 1], "rotation": "positive"}
MESH = {"mesh": "meshes/fan.inp", "material": MATERIAL, **AXES, "root": "hub", "tip": {"r_at_least_m": 0.25}}
MATRICES = {"matrices": "meshes/fan", "mass_unit": "t", "stiffness_unit": "N/mm", **AXES}


@pytest.fixture
def settings_with(config_copy):
    """Settings of a project with a blade Fan and what else is given; a value None takes a key out of Fan."""
    folder = config_copy / "meshes/fan"
    folder.mkdir(parents=True)
    (config_copy / "meshes/fan.inp").write_text("*NODE\n*INCLUDE, INPUT=more.inc\n")
    (config_copy / "meshes/more.inc").write_text("1, 0, 0, 0\n")
    for name in ("M.mtx", "K_0.mtx", "K_1000.mtx", "K_2000.mtx", "boundary.csv"):
        (folder / name).write_text("")

    def read(entry, others=(), config=(), blades=("Fan",)):
        fan = {key: value for key, value in entry.items() if value is not None}
        with open(config_copy / "config/blades.yaml", "a") as stream:
            stream.write(yaml.safe_dump({"Fan": fan} | dict(others), sort_keys=False))
        file = config_copy / "config/config.yaml"
        text = file.read_text().replace("blades: all ", f"blades: [{', '.join(blades)}] ")
        for old, new in dict(config).items():
            assert old in text
            text = text.replace(old, new)
        file.write_text(text)
        return read_settings(config_copy)

    return read


def test_a_mesh_has_what_it_leaves_out_from_its_base(settings_with, config_copy):
    """Also key by key inside sections."""
    (config_copy / "meshes/other.inp").write_text("*NODE\n1, 0, 0, 0\n")
    other = {"base": "Fan", "mesh": "meshes/other.inp", "material": {"density_kg_m3": 4500.0}, "root": "foot"}
    blades = settings_with(MESH, {"Other": other}, blades=("Fan", "Other")).blades
    own, base = blades["Other"], blades["Fan"]
    definition = replace(
        base.definition, file="meshes/other.inp", root=Where(("foot",), tolerance=0.0), digest=own.definition.digest
    )
    assert own.definition == definition and own.definition.digest != base.definition.digest
    assert own.material == replace(base.material, density=4500.0)
    wrong = (config_copy / "config/blades.yaml").read_text().replace("base: Fan", "base: Fun")
    (config_copy / "config/blades.yaml").write_text(wrong)
    with refused(r"Other\.base: found 'Fun'; allowed: another blade .*did you mean Fan", ConfigError):
        read_settings(config_copy)


def test_a_mesh_with_strengths_has_fatigue_where_stress_is_wanted(settings_with):
    strengths = {"fatigue_strength_pa": 3e8, "ultimate_strength_pa": 1e9}
    settings = settings_with(MESH | {"material": MESH["material"] | strengths}, {"Plain": MESH}, blades=("Fan", "Plain"))
    assert "fatigue" in settings.results_of("Fan", "abradable")
    assert "fatigue" not in settings.results_of("Plain", "abradable")


def test_runs_that_end_as_they_have_settled_have_no_signals_by_default(settings_with, config_copy):
    overlay(config_copy, "scenes.yaml", "direct: { until: settled }")
    wanted = targets(Sweep(settings_with(MESH)))
    assert wanted["<results>/{blade}/{scene}/signals.nc"] == [{"blade": "Fan", "scene": "abradable"}]


TABLE = Path(__file__).with_name("refusals.txt")
ENTRIES = {"mesh": MESH, "matrices": MATRICES, "base: a mesh": MESH, "base: matrices": MATRICES}


@pytest.mark.parametrize(("kind", "changes", "message"), refusal_rows(TABLE, *ENTRIES))
def test_what_is_refused_of_an_imported_blade(settings_with, kind, changes, message):
    """Of its entry, and of one that has it as the base: an imported blade has no table to vary."""
    entry, changed = ENTRIES[kind], yaml.safe_load(changes)
    with refused(rf"^config/blades\.yaml:\d+: {pattern_of(message)}", ConfigError):
        if kind.startswith("base"):
            settings_with(entry, {"Other": {"base": "Fan"} | changed}, blades=("Other",))
        settings_with(entry | changed)


def test_a_mesh(settings_with, config_copy):
    settings = settings_with(MESH | {"pressure_side": "backward", "axis_point": [1, 2, 3]})
    source = settings.blades["Fan"].definition
    assert (source.file, source.root) == ("meshes/fan.inp", Where(("hub",), tolerance=0.0))
    assert source.tip == Where(limits=(("r", "at_least", 0.25),))
    assert not source.pressure_side_forward
    np.testing.assert_allclose(source.orientation.points_to_blade(np.array([[1.0, 2.0, 1003.0]])), [[1.0, 0.0, 0.0]])
    assert list(settings.stress_regions("Fan")) == ["airfoil", "airfoil_unfiltered"]
    assert settings.boundary_choice("Fan").contact == "patches"
    before = structure_hash(settings, "Fan")
    (config_copy / "meshes/more.inc").write_text("1, 0, 0, 1\n")
    assert structure_hash(read_settings(config_copy), "Fan") != before


def test_what_a_mesh_asks_is_answered_as_the_configuration_is_read(settings_with, config_copy):
    """As in a dry run: no job is needed."""
    settings_with(MESH)
    write_deck(config_copy / "meshes/asked.inp")
    entry = MESH | {"mesh": "meshes/asked.inp", "length_unit": "m", "rotor_axis": [0, 0, 1], "radial": [1, 0, 0]}
    overlay(config_copy, "blades.yaml", yaml.safe_dump({"Fan": entry | {"root": "?", "sense_check": False}}))
    with refused(r"Fan\.root: meshes/asked\.inp: root: found no set '\?'(.|\n)*\n  root: \{ cone_zr_m", ConfigError):
        read_settings(config_copy)


def test_a_mesh_with_another_material(settings_with):
    settings = settings_with(MESH, {"Heavy": {"base": "Fan", "material": {"density_kg_m3": 4500}}}, blades=("Fan", "Heavy"))
    assert settings.blades["Heavy"].material.density == 4500.0
    assert settings.blades["Heavy"].definition == settings.blades["Fan"].definition
    assert settings.designs.locations_of_keys("Heavy")["root"].endswith(": Fan.root")


@pytest.mark.parametrize(
    ("entry", "old", "new", "message"),
    [
        (MATRICES, "spin_softening: false", "spin_softening: true", r"\.spin_softening: .* put the term into its K_<speed>"),
        (MATRICES, "[abradable, direct]", "[growing_abradable]", r"\.centrifugal: found true, as.*'Fan', given by matrices"),
    ],
)
def test_what_an_imported_blade_cannot_have(settings_with, entry, old, new, message):
    with refused(message, ConfigError):
        settings_with(entry, config={old: new})


@pytest.fixture
def three(settings_with, config_copy, monkeypatch):
    """A blade of each kind, seen from the project's folder."""
    monkeypatch.chdir(config_copy)
    settings = settings_with(MESH, {"Given": MATRICES}, blades=("Ref", "Fan", "Given"))
    return Sweep(settings), Sweep(settings)


def test_plan_of_imported_blades(three, tmp_path, monkeypatch):
    imported, sweep = three
    fan, given = (SimpleNamespace(blade=blade, scene="direct", speed="750") for blade in ("Fan", "Given"))
    assert [*map(imported.pattern, ("geometry", "imported_mesh", "imported_matrices"))] == ["Ref", "Fan", "Given"]
    assert imported.files(fan) == ["meshes/fan.inp", "meshes/more.inc"]
    names = ["K_0.mtx", "K_1000.mtx", "K_2000.mtx", "M.mtx", "boundary.csv"]
    assert [file.rsplit("/", 1)[1] for file in imported.files(given)] == names
    assert imported.locations(fan)["tip"].endswith(": Fan.tip")
    assert sweep.runs_with("stress") == [(blade, scene) for blade in ("Ref", "Fan") for scene in ("abradable", "direct")]
    assert "stress" not in sweep.results(given)
    assert '"snapshots_per_revolution": 0' in sweep.task(given)
    response = next(figure for figure in FIGURES if figure.rule == "response_figure")
    stress = response.inputs(sweep)["stress"]
    assert stress({"blade": "Given"}) == [] and stress({"blade": "Fan"}) == "<results>/stress.nc"
    monkeypatch.chdir(tmp_path / "config")
    assert all(file.startswith("/") for file in imported.files(fan))
