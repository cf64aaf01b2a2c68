"""The models of the configuration: schemas for editors, lines in messages, and jobs that do without them."""

import json
import re
import subprocess
import sys

import pytest

from r37core.config import ConfigError, Settings, command_line_document, read_document
from r37core.product.reading import load_settings, read_settings
from r37core.product.schemas import schemas

FILES = ("config", "blades", "scenes", "fidelity")


def test_schemas_are_fresh(root):
    """`python -m r37core.product.schemas` renews them."""
    folder = root / "config/schemas"
    assert {file.name: file.read_text() for file in folder.iterdir()} == schemas()


def test_schemas_know_bounds_and_defaults(root):
    mesh = json.loads((root / "config/schemas/fidelity.schema.json").read_text())["$defs"]["Mesh"]["properties"]
    assert (mesh["nodes"]["minimum"], mesh["layers"]["default"]) == (500, 1)


@pytest.mark.parametrize("name", [*FILES, "physical"])
def test_files_name_their_schema(root, name):
    first = (root / f"config/{name}.yaml").read_text().splitlines()[0]
    schema = re.fullmatch(r"# yaml-language-server: \$schema=(schemas/[\w.]+)", first)[1]
    assert (root / "config" / schema).exists()


def line_of(file, text):
    return next(number for number, line in enumerate(file.read_text().splitlines(), 1) if text in line)


@pytest.mark.parametrize(
    ("name", "old", "new", "key"),
    [
        ("config", "nodes: 8", "nodes: 0", r"structure\.boundary\.nodes: found 0; allowed: integer, at least 1, at most 200"),
        ("config", "modes: 10", "moods: 10", r"campbell: found unknown key moods; allowed keys: .*\(did you mean modes\?\)"),
        ("config", "nodes: 8", "nodes:", r"structure\.boundary\.nodes: found nothing; allowed: a value, or the key left out"),
        ("config", "fidelity: standard", "fidelity: standart", r"fidelity: found 'standart'; allowed: draft, standard"),
        (
            "blades",
            "poissons_ratio: 0.3",
            "poissons_ratio: 0.5",
            r"Ref\.material\.poissons_ratio: found 0\.5; allowed: number, ",
        ),
        ("scenes", "thickness_m: 0.005", "thickness_m: 5 mm", r"abradable\.lining\.thickness_m: found '5 mm'; allowed: number"),
        (
            "scenes",
            "gap: linear # linear",
            "gap: curved # linear",
            r"abradable\.gap: found 'curved'; allowed: one of linear, exact",
        ),
        ("fidelity", "mesh: { nodes: 5000,", "mesh: { nodes: 5e3,", r"draft\.mesh\.nodes: found 5000\.0; allowed: integer"),
    ],
)
def test_messages_name_file_line_key_found_and_allowed(config_copy, name, old, new, key):
    file = config_copy / f"config/{name}.yaml"
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    with pytest.raises(ConfigError, match=rf"^config/{name}\.yaml:{line_of(file, new)}: {key}"):
        read_settings(config_copy)


def test_missing_key_is_named_where_it_should_stand(config_copy):
    file = config_copy / "config/scenes.yaml"
    line = line_of(file, "friction:")
    file.write_text(file.read_text().replace(", coefficient: 0.15", "", 1))
    expected = rf"scenes\.yaml:{line}: abradable\.friction: missing key coefficient; allowed keys: form, coefficient"
    with pytest.raises(ConfigError, match=expected):
        read_settings(config_copy)


def test_a_message_points_into_the_file_that_said_it(config_copy):
    (config_copy / "mine.yaml").write_text("# mine\n\nstructure:\n  boundary:\n    nodes: 0\n")
    with pytest.raises(ConfigError, match=r"^mine\.yaml:5: structure\.boundary\.nodes: found 0"):
        read_settings(config_copy, read_document(config_copy, "mine.yaml"))
    with pytest.raises(ConfigError, match=r"^--config: structure\.boundary\.nodes: found 0"):
        read_settings(config_copy, command_line_document({"structure": {"boundary": {"nodes": "0"}}}))


def test_changes_keep_what_they_do_not_name(config_copy):
    settings = read_settings(config_copy, command_line_document({"structure": {"boundary": {"nodes": "4"}}}))
    assert (settings.structure.boundary.nodes, settings.structure.boundary.tip_line) == (4, "pressure_edge")


def test_settings_can_be_given_as_a_dictionary(config_copy):
    settings = load_settings({"blades": ["Ref"], "scenes": ["direct"], "fidelity": "draft"}, config_copy)
    assert list(settings.speed_plans) == [("Ref", "direct")]


def test_simulations_do_not_import_the_models(root):
    script = (root / "workflow/scripts/simulate.py").read_text()
    imports = "\n".join(line for line in script.splitlines() if line.startswith("from r37core"))
    assert "run_job" in imports
    code = f"import sys\n{imports}\nprint(sorted({{'pydantic', 'yaml', 'netCDF4', 'xarray'}} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_settings_have_few_members():
    """What is of one subject stands with that: remarks, places, hashes, numbers of speeds."""
    own = {name for name in vars(Settings) if not name.startswith("__")} | set(Settings.__dataclass_fields__)
    assert len(own) <= 25


def test_a_plan_imports_no_optimiser():
    """It takes half a second at every start of Snakemake, and a plan builds no blade."""
    of_plans = "r37core.config, r37core.plans.sweep_plan"
    code = f"import sys, {of_plans}\nprint({{'scipy.optimize', 'scipy.interpolate'}} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"
