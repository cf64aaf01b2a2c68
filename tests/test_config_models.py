"""The models of the configuration: schemas for editors, lines in messages, and jobs that do without them."""

import re
import subprocess
import sys

import pytest
from test_refusals import edit

from r37core.config import ConfigError, Settings, command_line_document, read_document
from r37core.product.reading import read_settings
from r37core.product.schemas import schemas


def test_schemas_are_fresh(root):
    """`python -m r37core.product.schemas` renews them."""
    folder = root / "config/schemas"
    assert {file.name: file.read_text() for file in folder.iterdir()} == schemas()


@pytest.mark.parametrize("name", ["config", "blades", "scenes", "fidelity", "physical"])
def test_files_name_their_schema(root, name):
    first = (root / f"config/{name}.yaml").read_text().splitlines()[0]
    schema = re.fullmatch(r"# yaml-language-server: \$schema=(schemas/[\w.]+)", first)[1]
    assert (root / "config" / schema).exists()


def line_of(file, text):
    return next(number for number, line in enumerate(file.read_text().splitlines(), 1) if text in line)


@pytest.mark.parametrize(
    ("name", "old", "new", "key"),
    [
        (
            "config",
            "# nodes: 12",
            "nodes: 0",
            r"structure\.boundary\.nodes: found 0; allowed: integer, at least 1",
        ),
        ("config", "modes: 10", "moods: 10", r"campbell: found unknown key moods; allowed keys: .*\(did you mean modes\?\)"),
        (
            "config",
            "# nodes: 12 # left",
            "nodes: # left",
            r"structure\.boundary\.nodes: found nothing; allowed: a value, or the key left out",
        ),
        ("config", "fidelity: standard", "fidelity: standart", r"fidelity: found 'standart'; allowed: draft, standard"),
        ("blades", "ratio: 0.3", "ratio: 0.5", r"Ref\.material\.poissons_ratio: found 0\.5; allowed: number, "),
        ("scenes", "thickness_m: 0.005", "thickness_m: 5 mm", r"abradable\.lining\.thickness_m: found '5 mm'; allowed: number"),
        ("scenes", "gap: linear #", "gap: curved #", r"abradable\.gap: found 'curved'; allowed: one of linear, exact"),
        ("fidelity", "mesh: { nodes: 5000,", "mesh: { nodes: 5e3,", r"draft\.mesh\.nodes: found 5000\.0; allowed: integer"),
    ],
)
def test_messages_name_file_line_key_found_and_allowed(config_copy, name, old, new, key):
    file = config_copy / f"config/{name}.yaml"
    edit(file, old, new)
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


IMPORTED = {
    # by what forks for each of thousands of jobs
    "import r37core.console.fork_server, r37core.time_integration.speed_job": {"pydantic", "yaml", "netCDF4", "xarray"},
    # by every Snakemake, before ours sets the number of threads
    "import snakemake_executor_plugin_warm": {"numpy", "yaml"},
    "import r37core.base.plain": {"numpy", "pydantic", "yaml"},
    # it takes half a second at every start of Snakemake, and a plan builds no blade
    "import r37core.config, r37core.plans.sweep_plan": {"scipy.optimize", "scipy.interpolate"},
}
"""Imports -> what they must not bring along."""


@pytest.mark.parametrize("imports", IMPORTED)
def test_what_starts_often_is_light(imports):
    code = f"import sys\n{imports}\nprint({IMPORTED[imports]} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "set()\n"


def test_settings_have_few_members():
    """What is of one subject stands with that: remarks, places, hashes, numbers of speeds."""
    own = {name for name in vars(Settings) if not name.startswith("__")} | set(Settings.__dataclass_fields__)
    assert len(own) <= 25
