"""Scenes that start from others of their file: what they have from their base, refusals, and the same from Python."""

import json
import re

import jsonschema
import pytest

import r37
from r37core.base.yaml_file import load_yaml
from r37core.config import ConfigError, command_line_document, plain
from r37core.product.reading import read_settings

SHIPPED = "abradable, direct, material_abradable"


@pytest.fixture
def with_scenes(config_copy):
    def read(text, **keys):
        file = config_copy / "config/scenes.yaml"
        file.write_text(file.read_text() + text)
        return read_settings(config_copy, command_line_document({"scenes": "all", **keys})).scene_designs.entries

    return read


def test_a_scene_has_what_it_leaves_out_from_its_base(with_scenes):
    """Key by key inside sections, through several bases, in any order; lists are replaced, and null takes away."""
    entries = with_scenes(
        "Thinner: { base: Thin, casing: { lobes: 3, ring: null }, results: [stress] }\n"
        "Thin: { base: elastic_abradable, lining: { thickness_m: 0.003 }, until: null }\n"
        "Bare: { base: Thinner, lining: null, friction: null }\n"
    )
    shipped, thin, thinner, bare = (plain(entries[name]) for name in ("elastic_abradable", "Thin", "Thinner", "Bare"))
    assert thin == shipped | {"lining": shipped["lining"] | {"thickness_m": 0.003}}
    casing = {key: value for key, value in shipped["casing"].items() if key != "ring"} | {"lobes": 3}
    assert thinner == thin | {"casing": casing, "results": ["stress"]}
    assert bare == {key: value for key, value in thinner.items() if key not in ("lining", "friction")}


def test_the_page_has_scenes_of_one_s_own(with_scenes, root):
    page = (root / "docs/blades.md").read_text()
    entries = with_scenes(next(text for text in re.findall(r"```yaml\n(.*?)```", page, re.DOTALL) if text.startswith("Thin:")))
    assert entries["Thin"].lining.thickness_m == 0.003 and entries["Thin"].lining.contact_length_m == 1.585e-4
    assert entries["Round"].lining is None and entries["Round"].casing.lobes == 0


def test_a_family_may_have_a_base(with_scenes):
    entries = with_scenes("Rooms: { base: direct, vary: { casing.clearance_m: [3.0e-4, 5.0e-4] } }\n")
    for name, clearance in (("Rooms_0p0003", 3e-4), ("Rooms_0p0005", 5e-4)):
        assert entries[name].casing.clearance_m == clearance
        assert entries[name].friction == entries["direct"].friction


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("X: { base: abradible }\nY: { base: X }",
         rf"80: X\.base: found 'abradible'; allowed: another scene of .* \({SHIPPED}.*, Y\) \(did you mean abradable\?\)$"),
        ("X: { base: X }", rf"80: X\.base: found 'X'; allowed: another scene .* \({SHIPPED}.*\), in no circle of bases$"),
        ("X: { base: Y }\nY: { base: X }", r"81: Y\.base: found 'X'; .*\n.*80: X\.base: found 'Y'; .* in no circle of bases$"),
        ("F: { base: direct, vary: { gap: [2, 3] } }\nX: { base: F }", r"81: X\.base: found 'F'; allowed: another scene"),
        ("X: { base: 5 }", r"80: X\.base: found 5; allowed: string"),
        ("X: { base: null }", r"80: X\.base: found nothing; allowed: a value, or the key left out"),
        ("X: { base: nope }\nY: { base: direct, gap: odd }", r"81: Y\.gap: found 'odd'; .*\n.*80: X\.base: found 'nope'"),
        ("X: { base: abradable, lining: { barz: 1 } }", r"80: X\.lining: found unknown key barz; .*mean bars"),
        ("X: { base: direct, linning: null }", r"80: X: found unknown key linning; allowed keys: base, .*mean lining"),
        ("X: { base: direct, lining: { thickness_m: 0.001 } }", r"80: X\.lining: missing key elastic_modulus_pa"),
        ("X: { base: abradable, casing: null }", r"80: X: missing key casing; allowed keys: base, tip_line"),
        ("X: { base: abradable, lining: null }", r"19: X\.results: found wear; .* a lining \(given by 'abradable'\)$"),
        ("X: { casing: { clearance_m: 0.001 }, lining: null }", r"80: X\.lining: found nothing; allowed: a value"),
        ("X: { base: rotor_abradable, rotor: { longer_m: { 1: null } } }", r"80: X\.rotor\.longer_m\.1: found nothing"),
    ],
)  # fmt: skip
def test_refusals_name_the_line_of_the_value(with_scenes, text, message):
    with pytest.raises(ConfigError, match=rf"^config/scenes\.yaml:{message}"):
        with_scenes(f"{text}\n")


def test_a_wrong_value_of_a_base_is_told_once_and_of_the_base(with_scenes, config_copy):
    file = config_copy / "config/scenes.yaml"
    file.write_text(file.read_text().replace("thickness_m: 0.005", "thickness_m: -1"))
    with pytest.raises(ConfigError) as refusal:
        with_scenes("X: { base: material_abradable }\n")
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


def test_a_changed_scene_in_python_is_alone(config_copy):
    """What starts from it stays as it is; None takes away what the base has, too, and the base may be another one."""
    file = config_copy / "config/scenes.yaml"
    shipped = {name: r37.scene(name, file=file).entry for name in r37.scenes(file=file)}
    assert shipped["material_abradable"].lining.bar_width_m is None and shipped["direct"].lining is None
    bare = r37.scene("abradable", file=file, lining=None, results=["stress"])
    assert bare.entry == shipped["direct"].model_copy(update={"results": ["stress"]})
    for options in ({}, {"name": "Mine"}):
        bare = r37.scene("material_abradable", file=file, lining=None, results=["stress"], **options)
        assert bare.entry == shipped["direct"].model_copy(update={"results": ["stress"]})
        flexible = r37.scene("direct", file=file, base="elastic_abradable", **options)
        assert flexible.entry == shipped["elastic_direct"].model_copy(update={"results": shipped["direct"].results})
    with pytest.raises(ConfigError, match=r'^r37\.scene\("direct"\): direct\.base: found \'none\'; allowed: another scene of'):
        r37.scene("direct", file=file, base="none")
    with pytest.raises(ConfigError, match=r"material_abradable\.lining\.thickness_m: found -1"):
        r37.scene("material_abradable", file=file, **{"lining.thickness_m": -1})
