"""docs/configuration.md: a table of every key, and files of one's own beside the shipped ones."""

import re
import shutil
import subprocess

import pytest
from conftest import CHECKOUT
from evidence.key_tables import COLUMNS, UNIT_OF_SUFFIX, column_rows, filled, tables
from evidence.tables import read_table
from test_declared_keys import SealSection

from r37core.base.units import SUFFIXES
from r37core.config import ConfigError, read_document
from r37core.product import schemas
from r37core.product.extensions import read_settings


@pytest.fixture(scope="module")
def page(root):
    return (root / "docs/configuration.md").read_text()


@pytest.fixture(scope="module")
def rows():
    """File -> key -> the other cells of its row, the first where several kinds of a blade have it."""
    found = {}
    for name, text in tables().items():
        cells = [re.split(r"(?<!\\)\|", line)[1:-1] for line in text.splitlines() if line.startswith("| `")]
        found[name] = {row[0].split("`")[1]: [cell.strip() for cell in row[1:]] for row in reversed(cells)}
    return found


def test_the_page_is_fresh(page):
    """`PYTHONPATH=validation python -m evidence.key_tables` renews it."""
    assert filled(page) == page


def test_every_key_says_what_it_is(rows):
    assert [(name, key) for name, keys in rows.items() for key, cells in keys.items() if not cells[-1]] == []


@pytest.mark.parametrize(
    ("file", "key", "values"),
    [
        ("config", "structure.boundary.nodes", "integer 1..200"),
        ("config", "speeds[].start", "required; 0.001..1e+06 rad/s"),
        ("config", "speeds_for[].speeds", "list: 0.001..1e+06 rad/s; or section"),
        ("config", "signals.gauges.NAME.angle_deg", "`0`; -180..180 degrees"),
        ("config", "signals.probes_deg", "`[]`; list or []: at least 0, below 360 degrees"),
        ("config", "blades", "required; all; or list: name"),
        ("config", "tolerances.scenes", "`all`; all; or list: name"),
        ("blades", "material.density_kg_m3", "1..100000 kg/m³"),
        ("blades", "vary.NAME.step", "required; 1e-12..1e+12"),
        ("blades", "mesh", "required; path"),
        ("blades", "rotor_axis", "required; list of 3: -1e+09..1e+09"),
        ("blades", "thickness_percent", "10..1000 %; or section; or list of 2 or more: section"),
        ("scenes", "casing.cone_angle_deg", "`tip`; tip; or -80..80 degrees"),
        ("scenes", "rotor.mistuning_percent", "`{}`; values by name (%)"),
        ("fidelity", "time_integration.largest_time_step_s.lined", "required; 1e-12..0.01 s"),
    ],
)
def test_rows_have_default_and_allowed_values_with_their_unit(rows, file, key, values):
    assert rows[file][key][0] == values


def test_a_speed_and_the_same_in_rpm_share_a_row():
    text = tables()["config"]
    for names in ("speeds`, `speeds_rpm", "run_ups.NAME.from_rad_s`, `from_rpm", "run_ups.NAME.rate_rad_s2`, `rate_rpm_s"):
        assert f"\n| `{names}` | " in text
    assert "\n| `speeds_rpm`" not in text and ".from_rpm` |" not in text


def test_a_section_has_its_meaning_above_its_keys():
    assert "### casing\n\nRequired. Shape and elasticity of the casing.\n\n| key | values | meaning |" in tables()["scenes"]
    assert "### campbell\n\nThe Campbell diagram.\n\n| key |" in tables()["config"]


@pytest.mark.parametrize(
    ("file", "key", "words"),
    [
        ("config", "speeds_for[].speeds", "keys of `speeds`"),
        ("blades", "camber_deg", "keys of `stagger_deg`"),
        ("blades", "chord_percent", "keys of `stagger_deg`"),
        ("blades", "thickness_percent", "keys of `chord_percent`"),
        ("scenes", "rotor.longer_spread_m", ".NAME` of config.yaml"),
    ],
)
def test_rows_that_come_again_are_named_where_they_are(rows, file, key, words):
    assert rows[file][key][-1].endswith(words)


def test_every_key_of_the_shipped_files_is_there(root, rows):
    """As deep as the files go, with names and entries of lists as the page writes them."""
    for name, keys in rows.items():
        for path in read_document(root, f"config/{name}.yaml").locations:
            steps = path if name == "config" else path[1:]
            if "of_scenes" in steps or not steps:
                continue
            shown = ".".join("[]" if isinstance(step, int) else step for step in steps).replace(".[]", "[]")
            shown = re.sub(r"^(structure\.stress_regions)\.\w+", r"\1.NAME", shown)
            steps_up = shown.split(".")[:-1]
            # rows of models that come again are elsewhere
            referred = any("keys of `" in keys.get(".".join(steps_up[:end]), [""])[-1] for end in range(1, len(steps_up) + 1))
            assert shown.removesuffix("[]") in keys or referred or f"{shown}." in "\n".join(keys), (name, shown)


def test_every_unit_has_a_name():
    assert set(UNIT_OF_SUFFIX) == set(SUFFIXES)


def test_the_file_of_the_page_lies_on_top_of_the_shipped_one(page, config_copy):
    text = re.search(r"```yaml\n(.*?)```", page, re.DOTALL)[1]
    (config_copy / "config/my.yaml").write_text(text)
    settings = read_settings(config_copy, read_document(config_copy, "config/my.yaml"))
    assert (settings.blade_names, settings.scene_names) == (["Ref", "CS50"], ["abradable"])
    assert (settings.config.campbell.modes, settings.config.campbell.highest_engine_order) == (12, 20)
    assert settings.results.parts == ("results", "runs", "my_sweep")
    (config_copy / "config/my.yaml").write_text(text.replace("modes", "moods"))
    with pytest.raises(ConfigError, match=r"^config/my\.yaml:\d: campbell: found unknown key moods"):
        read_settings(config_copy, read_document(config_copy, "config/my.yaml"))


@pytest.mark.skipif(not shutil.which("git"), reason="git")
def test_git_ignores_files_of_ones_own_and_no_shipped_one(tmp_path):
    shutil.copy(CHECKOUT / ".gitignore", tmp_path)
    subprocess.run(["git", "init", "--quiet", tmp_path], check=True)
    shipped = [str(file.relative_to(CHECKOUT)) for file in (CHECKOUT / "tests/config").rglob("*.*")]
    shipped = [name.removeprefix("tests/") for name in shipped]
    own = ["config/my.yaml", "config/my_blades.yaml", "config/own/study.yaml", "config/own/profiles/fan.csv"]
    command = ["git", "-C", tmp_path, "check-ignore", *own, *shipped]
    assert subprocess.run(command, capture_output=True, text=True, check=False).stdout.split() == own


def test_the_page_of_a_declared_section(monkeypatch):
    monkeypatch.setitem(schemas.MODELS, "seal", SealSection)
    rows = tables()["seal"].splitlines()
    assert "| `clearance_m` | required; 1e-06..0.1 m | at rest |" in rows
    assert "| `slope_deg` | `tip`; tip; or above -90, below 90 degrees | of its face |" in rows
    assert "| `teeth` | `5`; integer at least 1 | how many |" in rows


def test_the_table_of_columns_is_fresh():
    """`PYTHONPATH=validation python -m evidence.key_tables` renews it."""
    rows = [list(row) for row in column_rows()]
    assert read_table(CHECKOUT / COLUMNS) == [["file", "column", "meaning"], *rows]
    assert len({(file, column) for file, column, _ in rows}) == len(rows)
