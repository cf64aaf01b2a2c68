"""Sections of studies in config.yaml that cannot be meant."""

from pathlib import Path

import pytest
from refusal_tables import check_refusal, refusal_rows
from test_search import BLADES, SEARCH
from workflow_runs import overlay

from r37core.config import ConfigError, command_line_document, read_document
from r37core.product.extensions import read_settings

ROWS = refusal_rows(Path(__file__).with_name("refusals.txt"), "config", "blades", "scenes", "search")


@pytest.mark.parametrize(("kind", "snippet", "message"), ROWS)
def test_what_is_refused_of_a_study(config_copy, kind, snippet, message):
    if kind == "search":
        # snippets lie on top of a search that can be run
        overlay(config_copy, "blades.yaml", BLADES)
        overlay(config_copy, "scenes.yaml", "direct: { damping_ratio: 0.001 }")
        overlay(config_copy, "config.yaml", SEARCH)
        kind = "config"
    check_refusal(config_copy, kind, snippet, message)


def told(folder, *changes, **values):
    """Lines of the refusal of a configuration."""
    with pytest.raises(ConfigError) as refused:
        read_settings(folder, *changes, command_line_document(values))
    return str(refused.value).splitlines()


@pytest.mark.parametrize("snippet", [snippet for kind, snippet, _ in ROWS[::5] if kind == "config"])
def test_no_check_stumbles_over_what_another_has_refused(config_copy, snippet):
    (config_copy / "mine.yaml").write_text(snippet.replace(" / ", "\n"))
    lines = told(config_copy, read_document(config_copy, "mine.yaml"), blades=["Reff"], scenes=["wet"], fidelity="finest")
    assert len(set(lines)) == len(lines)
    assert all(": found " in line or ": missing key " in line for line in lines)


def test_mistakes_of_several_studies_are_told_once_each(config_copy):
    up = {"from_rad_s": 900, "to_rad_s": 2100, "revolutions": 5}
    sections = {"run_ups": {"a": up, "b": {"blades": ["Reff"]} | up}, "signals": {"speeds_rad_s": [900], "blades": ["Reff"]}}
    lines = told(config_copy, **sections)
    places = ["run_ups.a.revolutions", "run_ups.b.blades", "signals.blades"]
    assert sorted(line.split(":")[1].strip() for line in lines) == places


def test_signals_of_no_scene_are_refused(config_copy):
    scenes = config_copy / "config/scenes.yaml"
    scenes.write_text(scenes.read_text().replace("signal, ", ""))
    found = (
        "signals.speeds_rad_s: found speeds, though no scene that is run has signal among its results; allowed: such a scene"
    )
    (line,) = told(config_copy, signals={"speeds_rad_s": "interactions"})
    assert line.startswith(f"--config: {found} (abradable, direct of config/scenes.yaml")
