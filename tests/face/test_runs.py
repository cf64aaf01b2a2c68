"""r37.run: the workflow in a folder of its own, which goes on where it was, and says of a failure what the job raised."""

import os
import shutil
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pandas as pd
import pytest
import xarray as xr
import yaml
from refusal_tables import pattern_of, refusal_rows
from workflow_runs import LONGEST, digests, snakemake, wait_until

import r37
from r37 import workflow_process
from r37core.base.yaml_file import load_yaml, yaml_text
from r37core.blade.profile import BladeShapeError
from r37core.config.settings import merged_settings
from r37core.product.extensions import read_settings

pytestmark = pytest.mark.usefixtures("warm_calls")

ASKED = {"blades": ["CS100"], "scenes": "abradable", "speeds": [750, 1150], "results": ["stress"]}


@pytest.fixture(scope="module")
def once(config, tmp_path_factory):
    """The folder of a run that was done in one go."""
    folder = tmp_path_factory.mktemp("runs") / "once"
    r37.run(**ASKED, config=config, cores=2, folder=folder)
    return folder


def processes_of(folder):
    numbers = []
    for number in filter(str.isdigit, os.listdir("/proc")):
        with suppress(OSError):
            if os.readlink(f"/proc/{number}/cwd").startswith(str(folder)):
                numbers.append(int(number))
    return numbers


def started(config, folder):
    """A process of its own that makes the same run."""
    code = f"import r37; r37.run(**{ASKED}, config={str(config)!r}, cores=2, folder={str(folder)!r})"
    # whatever this process does with an interrupt
    default = lambda: signal.signal(signal.SIGINT, signal.default_int_handler)  # noqa: E731
    return subprocess.Popen([sys.executable, "-W", "ignore", "-c", code], stderr=subprocess.PIPE, preexec_fn=default)


@pytest.mark.slow
def test_a_folder_has_all_of_a_run_and_snakemake_finds_nothing_to_do(once, config):
    assert "Nothing to be done" in snakemake(once, "tables", "--cores", "1", "--dry-run")
    settings = read_settings(once)
    assert settings.blade_names == ["CS100"] and settings.scene_names == ["abradable"]
    assert settings.blades["CS100"].definition == read_settings(config.parent.parent).blades["CS100"].definition
    assert list(r37.open_results(once / "results")) == ["campbell", "rms", "stress"]
    # tables travel with it
    assert (once / "config/profiles/rotor37.csv").is_file()
    before = digests(once)
    again = r37.run(**ASKED, config=config, folder=once)
    assert digests(once) == before and again.folder == once / "results"
    # what was asked for once more is made, and the rest stays
    more = r37.run(**{**ASKED, "speeds": [750, 1150, 1550]}, config=config, cores=2, folder=once)
    assert list(more["rms"].speed.values) == [750.0, 1150.0, 1550.0]
    speed = "results/CS100/abradable/speed_750.npz"
    assert digests(once)[speed] == before[speed]
    r37.run(**ASKED, config=config, cores=2, folder=once)
    assert {name: digests(once)[name] for name in before} == before


@pytest.mark.slow
@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGKILL])
def test_a_run_that_was_ended_leaves_no_process_and_goes_on_with_the_same_bytes(once, config, tmp_path, end):
    folder = tmp_path / "ended"
    call = started(config, folder)
    wait_until(lambda: list((folder / "results").glob("*/abradable/speed_*.npz")), LONGEST, "a simulation")
    call.send_signal(end)
    call.wait(LONGEST)
    assert (f"the same call goes on with what is in {folder}" in call.stderr.read().decode()) == (end == signal.SIGINT)
    # whoever is killed cannot wait for the others
    wait_until(lambda: not processes_of(folder), LONGEST, "its processes")
    reached = digests(folder)
    r37.run(**ASKED, config=config, cores=2, folder=folder)
    done, other = digests(folder), digests(once)
    assert done == {name: other[name] for name in done} and "results/ranking.csv" in done
    # a hidden file is one that was being written
    simulated = [name for name in reached if name.endswith(".npz") and not name.split("/")[-1].startswith(".")]
    assert simulated and {name: reached[name] for name in simulated} == {name: done[name] for name in simulated}


@pytest.mark.slow
def test_a_failed_job_raises_what_it_raised(config, tmp_path):
    thick = r37.blade("Ref", config=config, thickness_percent=1000, name="Thick")
    with pytest.raises(BladeShapeError, match="blade Thick: span 0%: no pressure-side arc") as raised:
        r37.run([thick, "Ref"], "abradable", [1150], config=config, folder=tmp_path / "thick")
    assert "details in logs/Thick/geometry.log" in raised.value.__notes__[0]


@pytest.mark.parametrize(("kind", "changes", "message"), refusal_rows(Path(__file__).with_name("refusals.txt"), "runs"))
def test_what_cannot_be_run_is_refused(config, kind, changes, message):
    with pytest.raises(r37.ConfigError, match=pattern_of(message)):
        r37.run(**{**ASKED, "config": config, **yaml.safe_load(changes)})


def test_a_folder_with_something_else_stays_as_it_is(config, tmp_path):
    (tmp_path / "config").mkdir()
    (tmp_path / "config/config.yaml").write_text("blades: all\n")
    with pytest.raises(r37.ConfigError, match="which has something else in it"):
        r37.run(**ASKED, config=config, folder=tmp_path)
    assert (tmp_path / "config/config.yaml").read_text() == "blades: all\n"
    (tmp_path / "file").write_text("")
    with pytest.raises(r37.ConfigError, match="which cannot be written"):
        r37.run(**ASKED, config=config, folder=tmp_path / "file/folder")


@pytest.fixture
def written(monkeypatch):
    """The settings of a call, and its targets, without the run itself."""
    asked = []

    def run_workflow(settings, folder, targets, cores):
        asked.append((read_settings(folder), targets))

    monkeypatch.setattr("r37.runs.run_workflow", run_workflow)
    return asked


def test_a_folder_says_what_the_call_said(config, written, tmp_path):
    """Blades and scenes of Python, sections by name, tables as DataFrames: as files that are read to the same settings."""
    table = pd.DataFrame({"blade": ["Near", "Far"], "sweep_percent": [50.0, 80.0]})
    swept = r37.blade("CS50", config=config, lean_percent=40, name="Swept")
    smooth = r37.scene("abradable", config=config, name="smooth", **{"friction.coefficient": 0.05, "lining.bars": 5000})
    r37.run([swept, "Ref"], smooth, [1150], config=config, interactions={"prominence": 0.2}, folder=tmp_path / "a")
    ((settings, targets),) = written
    assert targets == ["tables"] and settings.config.interactions.prominence == 0.2
    assert settings.blades["Swept"] == swept.settings and list(settings.scenes) == ["smooth"]
    assert settings.scene_designs.entries["smooth"] == smooth.entry
    family = r37.blade("S100", config=config, designs=table, name="Shares")
    r37.run(family, "abradable", [1150], config=config, folder=tmp_path / "b")
    assert written[-1][0].blade_names == ["Near", "Far"]
    for name, share in (("Near", 50), ("Far", 80)):
        expected = r37.blade("S100", config=config, sweep_percent=share).settings.definition.stacking
        assert written[-1][0].blades[name].definition.stacking == expected
    # a table of the same name from elsewhere lies beside the other
    other = tmp_path / "other/config"
    shutil.copytree(config.parent, other)
    rows = (other / "profiles/rotor37.csv").read_text()
    material = "{ youngs_modulus_pa: 1.0e+11, density_kg_m3: 4430, poissons_ratio: 0.3, yield_stress_pa: 1.0e+9 }"
    entries = {"A": config.parent, "B": other}.items()
    lines = [f"{name}: {{ profiles: {place}/profiles/rotor37.csv, material: {material} }}\n" for name, place in entries]
    (other / "blades.yaml").write_text("".join(lines))
    (other / "profiles/rotor37.csv").write_text(rows.replace("\r", "") + "\n")
    r37.run(["A", "B"], "abradable", [1150], config=other / "config.yaml", folder=tmp_path / "c")
    assert {file.name for file in (tmp_path / "c/config/tables").iterdir()} == {"rotor37.csv", "_rotor37.csv"}


def test_the_configuration_counts_unless_an_argument_replaces_it(config, written, tmp_path):
    r37.run(config=config, folder=tmp_path / "a")
    assert merged_settings(written[-1][0]) == merged_settings(read_settings(config.parent.parent))
    r37.run(speeds_rpm=[9000], results=["wear"], blades="Ref", scenes="abradable", config=config, targets=["rms", "summary"])
    settings, targets = written[-1]
    assert targets == ["rms", "summary"] and settings.results_of("Ref", "abradable") == ("wear",)
    assert [plan.certain for plan in settings.speed_plans.values()] == [(pytest.approx(942.4778),)]
    r37.run(results=["stress"], config=config, folder=tmp_path / "b")
    assert {settings.results_of(*pair) for settings, _ in written[-1:] for pair in settings.speed_plans} == {("stress",)}


def test_texts_that_look_like_numbers_stay_texts(tmp_path):
    values = {"a": "1e5", "b": "007", "c": "true", "d": "~", "e": 1e-5, "f": [1, 2.5, "x: y"], "g": {"h": "1/2540"}, "i": 1e22}
    (tmp_path / "a.yaml").write_text(yaml_text(values))
    assert load_yaml(tmp_path / "a.yaml") == values


def test_what_a_run_says_becomes_the_error_that_it_is(config, tmp_path):
    report = workflow_process._Report(read_settings(config.parent.parent))
    for text, kind in {
        "ConfigError:\nblades: found none": r37.ConfigError,
        "InputFileError: a.nc: cannot be read": r37.InputFileError,
        "Error: Directory cannot be locked. Please make sure": r37.ConfigError,
        "something else": RuntimeError,
    }.items():
        report._messages[:] = [text, text]
        error = report.error(tmp_path)
        assert type(error) is kind and "\n" not in str(error)
    report._messages.clear()
    report.take("text", "Killed")
    assert "Killed" in str(report.error(tmp_path))
    report.take("event", '{"event": "failure", "line": "rule a: broken", "error": "no pickle"}')
    assert type(report.error(tmp_path)) is RuntimeError and str(report.error(tmp_path)) == "rule a: broken"


@pytest.mark.slow
def test_targets_are_those_of_the_workflow(once, config):
    results = r37.run(**ASKED, config=config, folder=once, targets=["results/figures/ranking.png", "results/campbell.nc"])
    assert (results.folder / "figures/ranking.png").is_file()
    xr.testing.assert_identical(results["campbell"], r37.open_results(once / "results")["campbell"])
