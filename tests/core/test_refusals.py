"""Configurations that cannot be meant: each ends in one message with file, line and key."""

import os
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from call_counts import calls_of
from pydantic import TypeAdapter
from refusal_tables import check_refusal, refusal_rows

from r37core.base.io import TextFileError
from r37core.base.speeds import exact_text
from r37core.base.yaml_file import load_yaml, load_yaml_with_lines, yaml_text
from r37core.config import ConfigError, Document, command_line_document
from r37core.config.section import Unique
from r37core.product.extensions import read_settings
from r37core.product.schemas import MODELS

TABLE = Path(__file__).with_name("refusals.txt")


def edit(file, old, new):
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))


def numbers(content, path=()):
    """Path of every number, but not of truth values."""
    if isinstance(content, bool):
        return
    if isinstance(content, int | float):
        yield path
    parts = content.items() if isinstance(content, dict) else enumerate(content) if isinstance(content, list) else ()
    for key, value in parts:
        yield from numbers(value, (*path, key))


def changed_content(content, path, value):
    if not path:
        return value
    step, *rest = path
    changed = list(content) if isinstance(content, list) else dict(content)
    changed[step] = changed_content(content[step], rest, value)
    return changed


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize(
    "value",
    [float("nan"), float("inf"), -float("inf"), 1e300, pytest.param(10**399, id="400 digits"), "text", None, True, [], {}],
)
def test_no_number_may_be_anything_else(root, name, value):
    """Every number of every file, replaced by something that is none or by one out of all bounds."""
    content = load_yaml(root / f"config/{name}.yaml")
    for path in numbers(content):
        with pytest.raises(ConfigError, match=r"^a\.yaml: .*: (found|at least|missing key)"):
            Document("a.yaml", changed_content(content, path, value)).check(MODELS[name])


@pytest.mark.parametrize("name", MODELS)
def test_what_cannot_be_zero_cannot_be_almost_zero(name):
    """A rate of 5e-324 was divided by: each number that is more than 0 has a bound that somebody can mean."""
    schema = str(MODELS[name].model_json_schema())
    assert not re.search(r"'exclusiveMinimum': 0(\.0)?\b", schema)


@pytest.mark.parametrize(("kind", "snippet", "message"), refusal_rows(TABLE, "config", "blades", "scenes"))
def test_what_is_refused_in_a_file(config_copy, kind, snippet, message):
    check_refusal(config_copy, kind, snippet, message)


def test_an_elastic_casing_under_a_rotor_is_not_for_central_differences(config_copy):
    edit(config_copy / "config/scenes.yaml", "elastic_direct:\n", "elastic_direct:\n  rotor: { blades: 4 }\n")
    changes = {"scenes": ["elastic_direct"]}
    read_settings(config_copy, command_line_document(changes))
    message = r"elastic_direct\.rotor: found a rotor in an elastic casing at the level 'paper', .*; allowed: a level of exact"
    with pytest.raises(ConfigError, match=message):
        read_settings(config_copy, command_line_document(changes | {"fidelity": "paper"}))


def test_runs_that_settle_are_of_single_blades_without_signals(config_copy):
    """A scene's until is that of its level unless it has one; a rotor, and signals, need runs of one length."""
    edit(config_copy / "config/fidelity.yaml", "revolutions: 200,", "revolutions: 200, until: settled,")
    draft = {"fidelity": "draft", "scenes": ["abradable", "direct"]}
    edit(config_copy / "config/scenes.yaml", "\ndirect:\n", "\ndirect:\n  until: revolutions\n  revolutions: 300\n")
    settings = read_settings(config_copy, command_line_document(draft))
    choices = {scene: settings.integration_choice("Ref", scene) for scene in draft["scenes"]}
    assert {scene: (choice.until_settled, choice.revolutions) for scene, choice in choices.items()} == {
        "abradable": (True, 200),
        "direct": (False, 300),
    }
    message = r"draft\.time_integration\.until: found settled with the rotor of 'rotor_abradable'; allowed: until: revolutions"
    with pytest.raises(ConfigError, match=message):
        read_settings(config_copy, command_line_document(draft | {"scenes": ["rotor_abradable"]}))
    edit(config_copy / "config/scenes.yaml", "rotor_abradable:\n", "rotor_abradable:\n  until: settled\n")
    with pytest.raises(ConfigError, match=r"scenes\.yaml:\d+: rotor_abradable\.until: found settled with a rotor; allowed: un"):
        read_settings(config_copy)


def test_a_run_of_too_many_steps_is_refused_and_a_long_one_says_so(config_copy):
    edit(config_copy / "config/fidelity.yaml", "revolutions: 200,", "revolutions: 5000,")
    message = (
        r"speeds: found 4\.9 rad/s, a revolution of 2e\+05 steps of 6\.4e-06 s, a run of 1e\+09 steps \(5000 revolutions\); "
        r"allowed: speeds from 4\.91 rad/s with this step and as many revolutions: a run has at most 1e\+09 steps"
    )
    with pytest.raises(ConfigError, match=message):
        read_settings(config_copy, command_line_document({"fidelity": "draft", "speeds": [4.9]}))
    # what is named as allowed is allowed; in the unit and the place that the speed was given in
    read_settings(config_copy, command_line_document({"fidelity": "draft", "speeds": [4.91]}))
    message = r"^r37\.sweep: speeds_rpm: found 4\.9\d* rad/s, .*; allowed: speeds from 4\.91 rad/s \(46\.9 rpm\) with"
    with pytest.raises(ConfigError, match=message):
        read_settings(config_copy, command_line_document({"fidelity": "draft", "speeds_rpm": [46.8]}, "r37.sweep"))


def test_a_run_that_would_not_fit_in_memory_is_refused(config_copy):
    edit(config_copy / "config/fidelity.yaml", "revolutions: 200,", "revolutions: 20000, samples_per_stress_instant: 10000,")
    message = r"fidelity\.yaml:\d+: draft\.time_integration\.revolutions: found 20000 of 620000 samples, .* GiB"
    with pytest.raises(ConfigError, match=message):
        read_settings(config_copy)


@pytest.mark.parametrize("name", ["config/config.yaml", "config/blades.yaml", "config/scenes.yaml", "config/fidelity.yaml"])
def test_texts_that_are_not_utf8(config_copy, name):
    file = config_copy / name
    text = file.read_text()
    file.write_bytes(b"\xef\xbb\xbf" + text.encode())
    read_settings(config_copy)
    for content, message in (
        (("# one\n# größe\n" + text).encode("latin-1"), "2: found the byte 0xf6, which is not UTF-8"),
        (text.encode("utf-16"), "1: found the byte 0xff, which is not UTF-8"),
        (b"", "1: the file is empty"),
        (b"[1, 2]\n", r"1: top level: found \[1, 2\]; allowed: (mapping|keys and values)"),
    ):
        file.write_bytes(content)
        with pytest.raises(ConfigError, match=rf"^{re.escape(name)}:{message}"):
            read_settings(config_copy)


@pytest.mark.parametrize(
    ("content", "message"),
    [(" " * 10**7, r"1: found 10000000 bytes; allowed: at most 2097152"), ("a: " + "[" * 20_000, "1: .*nested too deeply")],
)
def test_what_takes_long_to_read_is_refused_at_once(config_copy, content, message, monkeypatch):
    """Blanks took 0.1 s a MB, and brackets the square of their number."""
    opened, start = [], yaml.SafeLoader.fetch_flow_collection_start
    monkeypatch.setattr(yaml.SafeLoader, "fetch_flow_collection_start", lambda *given: opened.append(1) or start(*given))
    (config_copy / "config/scenes.yaml").write_text(content)
    with pytest.raises(ConfigError, match=rf"^config/scenes\.yaml:{message}$"):
        read_settings(config_copy)
    assert len(opened) < 1000


def test_the_cost_of_a_message_rises_with_the_errors():
    """It rose with their square, to half a minute for 20,000."""
    check = Document("a.yaml", {"blades": list(range(2000))}).check
    with pytest.raises(ConfigError, match=r"blades\.0: found 0; [\s\S]*\nand \d+ more$"):
        check(MODELS["config"])
    assert calls_of(Document("a.yaml", {"blades": list(range(4000))}).check, MODELS["config"]) < 2.5 * calls_of(
        check, MODELS["config"]
    )


def test_the_cost_of_a_list_without_doubles_rises_with_its_length():
    """It took 2.3 s of 20,000 names."""
    compared = []

    class Value(str):
        __hash__ = str.__hash__

        def __eq__(self, other):
            return compared.append(1) or str(self) == str(other)

    values = [Value(number) for number in range(2000)]
    assert TypeAdapter(Unique[Any]).validate_python(values) == values
    # the assertion itself compares each once
    assert len(compared) < 2 * len(values)


TABLES = ["config/profiles/rotor37.csv", "config/stacking/rotor37.csv"]


@pytest.mark.parametrize("name", TABLES)
def test_tables_as_spreadsheets_write_them(config_copy, name):
    before = read_settings(config_copy).blades
    file = config_copy / name
    text = file.read_text()
    file.write_bytes(b"\xef\xbb\xbf" + text.replace(",", ", ").replace("\n", " \r\n").encode())
    assert read_settings(config_copy).blades == before
    for separator in ";\t":
        european = text.replace(",", separator).replace(".", ",")
        file.write_text("Rotor 37, of a spreadsheet\n# 2 tables\n\n" + european, encoding="utf-8")
        assert read_settings(config_copy).blades == before


def test_a_pipe_is_refused_and_not_waited_for(config_copy):
    file = config_copy / TABLES[0]
    file.unlink()
    os.mkfifo(file)
    with pytest.raises(ConfigError, match=r"found a device or pipe"):
        read_settings(config_copy)


@pytest.mark.parametrize("name", TABLES)
@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda text: text.replace("\n", "\n<<<<<<< HEAD\n", 1), "2: the row has more or fewer cells"),
        (lambda text: text.replace(",", "|"), "1: the table lacks the columns .* separated by comma, semicolon or tab"),
        (lambda text: text.replace("\n", ",7\n").replace(",7\n", "\n", 1), "2: the row has more or fewer cells"),
        (lambda text: "", "1: the table lacks the columns"),
    ],
)
def test_tables_that_cannot_be_read(config_copy, name, change, message):
    file = config_copy / name
    file.write_text(change(file.read_text()))
    with pytest.raises(ConfigError, match=rf"^{re.escape(name)}: blade \w+: line {message}"):
        read_settings(config_copy)


def test_numbers_are_read_alike_everywhere_and_as_a_key_a_whole_one_is_its_text(tmp_path):
    file = tmp_path / "a.yaml"
    file.write_text("[1e-1, 2.5E-3, 1e9, 010, .5, -3., 1E+3, 12:30, 1_000, 0x10, 2020-01-01, +7]")
    assert load_yaml(file) == [0.1, 0.0025, 1e9, 10, 0.5, -3.0, 1000.0, "12:30", "1_000", "0x10", "2020-01-01", 7]
    file.write_text("{ 1: 0.4, 010: 2, '3': 1, -4: x }")
    assert load_yaml(file) == {"1": 0.4, "010": 2, "3": 1, "-4": "x"}
    file.write_text("{ 1: 0.4, '1': 0.4 }")
    with pytest.raises(TextFileError, match="the key '1' is given twice"):
        load_yaml(file)


def test_merged_mappings_give_what_a_mapping_does_not_have_itself(tmp_path):
    file = tmp_path / "a.yaml"
    file.write_text("a: &a {x: 1, y: 2}\nb: &b {y: 3, z: 4}\nc:\n  <<: [*a, *b]\n  x: 5\nd: {<<: *b, '<<': 6, v: <<}")
    content, lines = load_yaml_with_lines(file)
    assert content["c"] == {"x": 5, "y": 2, "z": 4} and content["d"] == {"y": 3, "z": 4, "<<": 6, "v": "<<"}
    assert [lines["c", key] for key in "xyz"] == [5, 1, 2]
    file.write_text(yaml_text(content))
    assert load_yaml(file) == content


ALIASES = ["a0: &a0 [1, 1]", *(f"a{i}: &a{i} [*a{i - 1}, *a{i - 1}]" for i in range(1, 40))]
ODD = dict.fromkeys(["a: [" * 2000, "a: \x07", "a: &a [*a]", "a: 1\n---\nb: 2", "a: !!python/name:os.x"])
ODD |= {"a: {<<: 1}": "expected a mapping or list of mappings for merging", "a: &a {<<: *a, b: 1}": "nested too deeply"}
ODD |= {"\n".join(ALIASES): "more than 100000 values"}


@pytest.mark.parametrize("text", ODD)
def test_odd_yaml_ends_in_one_line(tmp_path, text):
    file = tmp_path / "a.yaml"
    file.write_text(text)
    with pytest.raises(TextFileError, match=ODD[text]) as caught:
        load_yaml(file)
    assert "\n" not in str(caught.value)
    assert caught.value.line >= 1


def test_lists_of_numbers_on_the_command_line(config_copy):
    """Snakemake hands them on as texts."""
    given = {
        "speeds": ["900", "1e3", {"start": "1100", "stop": "1200", "step": "50"}],
        "blades": ["Ref"],
        "interactions": {"prominence": 0.1},
    }
    settings = read_settings(config_copy, command_line_document(given))
    assert settings.speed_plans["Ref", "direct"].certain == (900.0, 1000.0, 1100.0, 1150.0, 1200.0)
    for value, found in (("nan", "nan"), ("inf", "inf"), ("abc", "abc"), ("-900", "-900")):
        with pytest.raises(ConfigError, match=rf"^--config: speeds\.0: found '?{found}'?; allowed: number"):
            read_settings(config_copy, command_line_document({"speeds": [value]}))
    with pytest.raises(ConfigError, match=r"^--config: speeds: found nothing"):
        read_settings(config_copy, command_line_document({"speeds": None}))


def test_speeds_stand_exactly_in_file_names():
    near = np.nextafter(1000.0, 2000.0)
    for speed in (750.0, 1000.5, 0.1, 1e-3, 1e6, 123456.123456789, near, 1000.0 / 3.0):
        text = exact_text(speed)
        assert float(text) == speed
        assert re.fullmatch(r"[0-9.]+", text)
    assert exact_text(750.0) == "750"
    assert exact_text(near) != exact_text(1000.0)
