"""Configurations that cannot be meant: each ends in one message with file, line and key."""

import re
from typing import Any

import numpy as np
import pytest
import yaml
from call_counts import calls_of
from pydantic import TypeAdapter

from r37core.base.io import TextFileError
from r37core.base.speeds import exact_text
from r37core.base.yaml_file import load_yaml, load_yaml_with_lines, yaml_text
from r37core.config import ConfigError, Document, command_line_document
from r37core.config.remarks import remarks_on_speeds
from r37core.config.section import Unique
from r37core.product.extensions import read_settings
from r37core.product.schemas import MODELS


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


def section(text, message):
    """config.yaml with one more section."""
    return "# exports:", f"{text}\n\n# exports:", message


def signals(text, message):
    return section(f"signals: {{ {text} }}", rf"signals\.{message}")


def run_up(text, message):
    return section(f"run_ups: {{ a: {{ {text} }} }}", rf"run_ups\.a{message}")


def between(first, last, key, value, message):
    """A run-up between two speeds (rad/s); the key is refused."""
    return run_up(f"from_rad_s: {first}, to_rad_s: {last}, {key}: {value}", rf"\.{key}: {message}")


def about_crossing(order, first, others, message):
    return run_up(f"crossing: {{ mode: 1B, engine_order: {order}, first: {first}, last: 0.1 }}, {others}", message)


def parameter(text, message):
    return section(f"tradeoff: {{ parameters: {{ {text} }} }}", rf"tradeoff\.parameters{message}")


def rule(text, message):
    return "speeds_for: []", f"speeds_for: [{{ {text} }}]", message


def speeds(text, message):
    return "start: 750, stop: 2000, step: 20, refine_to: 1", f"start: 750, {text}", rf"speeds{message}"


CONFIG_REFUSALS = [
    signals("probes_deg: [10]", "probes_deg: found probes_deg without speeds; allowed: speeds_rad_s"),
    signals("gauges: { a: { chord: 0.5, span: 0.5, side: suction } }", r"gauges: found gauges without speeds"),
    signals("speeds_rad_s: [9], probes_deg: [1, 2, 1.0]", r"probes_deg\.2: found a probe at 1 degrees twice; allowed: each"),
    signals("speeds_rad_s: [900, 900]", r"speeds_rad_s\.1: found 900(\.0)? twice; allowed: each once"),
    signals("speeds_rad_s: [900], revolutions: 500", "revolutions: found 500; allowed: at most those of a run, 200 in 'abrad"),
    section(
        "operating: { idle_rad_s: 900, redline_rad_s: 1300 }\n"
        "requirements: { campbell_margins: [{ mode: '', engine_orders: [4], at_least_percent: 5 }] }",
        r"requirements\.campbell_margins\.0\.mode: found ''; allowed: 1B, 1T, 2B",
    ),
    signals("speeds_rad_s: [0.02]", r"speeds_rad_s: found 0\.02 rad/s, a revolution of"),
    run_up("from_rad_s: 9, to_rad_s: 10", r"\.rate_rad_s2: found nothing; allowed: one of rate_rad_s2, rate_rpm_s, rev"),
    run_up("from_rad_s: 9, from_rpm: 9, to_rad_s: 10", r"\.from_rpm: found from_rad_s and from_rpm; allowed: one of"),
    between(900, 900, "rate_rpm_s", 5, "found a rate between equal speeds; allowed: revolutions"),
    between(900, 1000, "rate_rad_s2", 1e-3, r"found a change from 900 .* 1\.512e\+07 revolutions; allowed: .* from 0\.151"),
    between(900, 1900, "revolutions", 0.1, r"found a change from 900 to 1900 .* within 0\.1 revolutions; allowed: 0\.347 to 1"),
    between(1999, 1999.0000001, "rate_rad_s2", 10, r"found a change from 1999 to 1999\.0000001 rad/s within"),
    between(1900, 2100, "revolutions", 5, r"found 2100 rad/s; allowed: up to structure\.maximum_speed_rad_s, 2000"),
    run_up("from_rad_s: 9, to_rad_s: 10, revolutions: 5, blades: [Reff]", r"\.blades: found 'Reff'; allowed: Ref, L50"),
    run_up("from_rad_s: 900, to_rad_s: 1000, rate_rad_s2: 10, lining: worn", r"\.lining: found worn in the scene 'direct', wh"),
    about_crossing(4, 0.0, "from_rad_s: 900, revolutions: 5", r"\.crossing: found from_rad_s and crossing; allowed: one of"),
    about_crossing(4, -0.5, "revolutions: 0.1", r"\.revolutions: found a change from 1000 to 2200 rad/s within 0\.1 revol"),
    about_crossing(40, 0.0, "revolutions: 5", r"\.crossing\.engine_order: found 40; allowed: at most campbell\.highest_engine"),
    section(
        "run_ups: { a: { from_rad_s: 9, to_rad_s: 10, revolutions: 1 }, A: { from_rad_s: 9, to_rad_s: 10, revolutions: 1 } }",
        r"run_ups\.A: found 'A' beside 'a'",
    ),
    section("tradeoff: { blade: Reff }", r"tradeoff\.blade: found 'Reff'; allowed: Ref, L50"),
    section("tradeoff: { scenes: [wet] }", r"tradeoff\.scenes: found 'wet'; allowed: abradable"),
    section("tradeoff: { engine_order: 21 }", r"engine_order: found 21; allowed: at most campbell"),
    section("tradeoff: { base: standart }", r"tradeoff\.base: found 'standart'; allowed: draft"),
    section("stability: { extremes: [lobe] }", r"stability\.extremes\.0: found 'lobe'; allowed: all, or some of .*lobes"),
    parameter("level: { values: [draft, refrence], reference: draft }", r"\.level: found 'refrence'; allowed: draft"),
    parameter("bars:", r"\.bars: found nothing"),
    parameter("boundary_nodes: { values: [2, 4], reference: 15 }", ".*reference: found 15; allowed: one of the values, 2, 4"),
    parameter("boundary_nodes: { values: [2, 4, 4], reference: 2 }", r"\.boundary_nodes\.values\.2: found 4 twice"),
    parameter("stress_region: { values: [submesh, all], reference: submesh }", ".* found 'all'; .*one of submesh, whole"),
    rule("blades: [Reff], speeds: [900]", r"speeds_for\.0\.blades: found 'Reff'; allowed: Ref, L50"),
    rule("scenes: [dirct], speeds: [900]", r"speeds_for\.0\.scenes: found 'dirct'; allowed: abrad"),
    rule("blades: [Ref, Ref], speeds: [900]", r"speeds_for\.0\.blades\.1: found 'Ref' twice"),
    rule("scenes: [direct], speeds: [0.01]", r"speeds: found 0\.01 .* of 1\.31e\+08 steps .* from 0\.313 rad/s with"),
    speeds("stop: 700", r"\.0: found a range from 750 to 700; allowed: stop not below start"),
    speeds("stop: 2000, step: 1e-3", r": found 1\.25e\+06 speeds from 750 to 2000 .*; allowed: at most 100000"),
    speeds("stop: 2000, step: 0.02", ": found 875014 simulations of 7 blades in 2 scenes; allowed: at most 200000"),
    ("blades: all", "blades: [Ref, Ref]", r"blades\.1: found 'Ref' twice; allowed: each once"),
    ("blades: all", "blades: [50]", r"blades\.0: found 50; allowed: string"),
    ("blades: all", "blades:", r"blades: found nothing"),
    ("blades: all", "blades: Ref", r"blades: found 'Ref'; allowed: all or list of string"),
    ("blades_file: config/blades.yaml", "blades_file: ' '", r"blades_file: found ' '"),
    ("    corners: true", "    corners: 1", r"structure\.boundary\.corners: found 1; allowed: boolean"),
    ("fidelity: standard", "fidelity: standard\nfidelity: draft", r"the key 'fidelity' is given twice"),
    ("fidelity: standard", "fidelity:\tstandard", r"found a tab; indent with blanks"),
    ("fidelity: standard", "yes: standard", r"found the key 'yes', which is true or false in YAML"),
]


def with_rows(first_span, first_sweep, last_span, last_sweep, message):
    """A blade with two rows of sweep (cm) at some spans (%)."""
    spans = ((first_span, first_sweep), (last_span, last_sweep))
    rows = ", ".join(f"{{span_percent: {span}, sweep_cm: {sweep}, lean_deg: 0}}" for span, sweep in spans)
    return f"X: {{base: Ref, sweep_lean: [{rows}]}}", rf"X\.sweep_lean{message}"


BLADE_REFUSALS = [
    ("50: {base: Ref}", r"50: found '50'; allowed: a name of .* that is neither 'all' nor a number"),
    ("5.5: {base: Ref}", r"found the key '5\.5', which is a number in YAML; allowed: a name"),
    ("all: {base: Ref}", r"all: found 'all'; allowed: a name"),
    ("A__b: {base: Ref}", r"A__b: found 'A__b'; allowed: a name of letters, digits, hyphens and single underscores"),
    ('"A\\n": {base: Ref}', r"A\\n: found 'A\\n'; allowed: a name of letters"),
    ("figures: {base: Ref}", r"figures: found the blade 'figures'; allowed: another name"),
    ("ref: {base: Ref}", r"ref: found 'ref' beside 'Ref'; allowed: names that differ in more than capitals"),
    ("X: {base: Ref, stacking_table: .}", r"X\.stacking_table: config cannot be read: Is a directory"),
    ("X: {base: Ref, profiles: a.csv}", r"X\.base: found profiles and base; allowed: one of them"),
    (
        "X: {base: Ref, vary: {sweep_percent: {start: 0, stop: 10, step: 1e12}}}",
        r"X\.vary\.sweep_percent\.step: found 1e\+12; allowed: at most stop - start \(10\)",
    ),
    ("X: null", r"X: found nothing; allowed: mapping with the keys profiles, base"),
    ("X: {}", r"X: found neither profiles nor base"),
    ("X: {base: Nope}", r"X\.base: found 'Nope'; allowed: another blade"),
    ("X: {base: Y}\nY: {base: X}", r"Y\.base: found 'X'; allowed: another blade"),
    ("X: {base: Ref}\nX: {base: L50}", r"not readable as YAML: .*the key 'X' is given twice"),
    (
        "X: {base: Ref, chordwise_sweep_deg: 5, stacking_table: t.csv}",
        r"X\.chordwise_sweep_deg: found stacking_table and chordwise_sweep_deg",
    ),
    ("X: {base: Ref, stacking_table: config/stacking/rotor37.csv}", r"blade X: no row of the table has 'X'"),
    ("X: {profiles: config/profiles/rotor37.csv}", r"X\.material: missing key youngs_modulus_pa"),
    with_rows(0, 0, 90, 0, r": blade X: the spans run from 0% to 90%"),
    with_rows(0, 100, 100, 0, r": blade X: span 0%: found a sweep of 100 cm; allowed: up to the height of the blade, 7\."),
]


@pytest.mark.parametrize(("text", "message"), BLADE_REFUSALS)
def test_what_is_refused_in_blades_yaml(with_blades, text, message):
    with pytest.raises(ConfigError, match=rf"^config/(blades\.yaml:\d+|stacking/rotor37\.csv): .*{message}"):
        with_blades(text)


SCENE_REFUSALS = [
    ("[spectrum, signal, stress, wear, energy]", "[stress, stress]", r"abradable\.results\.1: found stress twice"),
    *(
        ("[spectrum, signal, stress, wear, energy]", f"[{kind}]", rf"\.results: found {kind}; allowed: only with stress")
        for kind in ("shapes", "fatigue", "static_stress")
    ),
    ("abradable:", '"abradable\\n":', r"abradable\\n: found 'abradable\\n'; allowed: a name of letters"),
    ("    bars: 10000", "    bars: 10_000", r"lining\.bars: found '10_000'; allowed: integer"),
    ("\ndirect:", "\ndirect:\n  stress_history_speeds_rad_s: [1717.5]", "stress_history.*: found 1717.5; allowed: speeds"),
]
REFUSALS = {"config": CONFIG_REFUSALS, "scenes": SCENE_REFUSALS}


@pytest.mark.parametrize(("name", "old", "new", "message"), [(name, *row) for name, rows in REFUSALS.items() for row in rows])
def test_what_is_refused_in_config_and_scenes_yaml(config_copy, name, old, new, message):
    edit(config_copy / f"config/{name}.yaml", old, new)
    with pytest.raises(ConfigError, match=rf"^config/{name}\.yaml:\d+: .*{message}"):
        read_settings(config_copy)


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
    choices = {scene: settings.integration_choice("Ref", scene, 900.0) for scene in draft["scenes"]}
    assert {scene: (choice.until_settled, choice.revolutions) for scene, choice in choices.items()} == {
        "abradable": (True, 200),
        "direct": (False, 300),
    }
    message = r"draft\.time_integration\.until: found settled with the rotor of 'rotor_abradable'; allowed: until: revolutions"
    with pytest.raises(ConfigError, match=message):
        read_settings(config_copy, command_line_document(draft | {"scenes": ["rotor_abradable"]}))
    with pytest.raises(ConfigError, match=r"signals\.speeds_rad_s: found speeds, with runs of 'abradable' that end as"):
        read_settings(config_copy, command_line_document(draft | {"signals": {"speeds_rad_s": [900]}}))
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
    settings = read_settings(config_copy, command_line_document({"fidelity": "draft", "speeds": [5]}))
    assert remarks_on_speeds(settings) == [
        "speeds: at 5 rad/s a run of 9.82e+08 steps (5000 revolutions) takes about 98 s of CPU time"
    ]
    assert not remarks_on_speeds(read_settings(config_copy, command_line_document({"fidelity": "draft", "speeds": [60]})))


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


@pytest.mark.parametrize("name", TABLES)
@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda text: text.replace("\n", "\n<<<<<<< HEAD\n", 1), "2: the row has more or fewer cells"),
        (lambda text: text.replace(",", ";"), "1: the table lacks the columns .* separated by commas"),
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
    given = {"speeds": ["900", "1e3", {"start": "1100", "stop": "1200", "step": "50"}], "blades": ["Ref"], "tolerance": 0.1}
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


def test_signals_of_no_scene_are_refused(config_copy):
    scenes = config_copy / "config/scenes.yaml"
    scenes.write_text(scenes.read_text().replace("signal, ", ""))
    edit(config_copy / "config/config.yaml", "speeds_for: []", "signals: { speeds_rad_s: interactions }")
    message = (
        r"signals\.speeds_rad_s: found speeds, though no scene that is run has signal among its results; allowed: such a scene"
    )
    with pytest.raises(ConfigError, match=rf"^config/config\.yaml:\d+: {message} \(abradable, direct of config/scenes\.yaml"):
        read_settings(config_copy)
