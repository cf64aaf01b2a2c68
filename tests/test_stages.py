"""What calls and the command say while they work, and how quickly the command starts."""

import ast
import io
import logging
import os
import signal
import subprocess
import sys

import pytest
import xarray as xr
from conftest import Terminal

import r37
from r37.command import main
from r37.stages import LOGGER, bar, stages
from r37core.base.units import RAD_S


class Notebook(io.StringIO):
    """The stream that a notebook's kernel puts in place of the terminal."""


Notebook.__module__ = "ipykernel.iostream"


@stages()
def call():
    LOGGER.info("mesh")


@pytest.mark.parametrize(("stream", "said"), [(Terminal(), "mesh\n"), (Notebook(), "mesh\n"), (io.StringIO(), "")])
def test_stages_are_told_where_a_person_watches(monkeypatch, stream, said):
    monkeypatch.setattr(sys, "stderr", stream)
    root = logging.StreamHandler(others := io.StringIO())
    logging.getLogger().addHandler(root)
    try:
        call()
        before, LOGGER.level = LOGGER.level, logging.WARNING
        call()
    finally:
        logging.getLogger().removeHandler(root)
        LOGGER.setLevel(logging.NOTSET)
    assert stream.getvalue() == said and others.getvalue() == ""
    assert before == logging.NOTSET and LOGGER.handlers == [] and LOGGER.propagate


def test_whoever_listens_to_the_logger_has_the_lines_alone(monkeypatch, caplog):
    monkeypatch.setattr(sys, "stderr", stream := Terminal())
    with caplog.at_level(logging.INFO, "r37"):
        call()
    assert caplog.messages == ["mesh"] and stream.getvalue() == ""


def test_many_speeds_have_a_bar_where_it_is_watched(monkeypatch):
    speeds = [1.0, 2.0]
    assert bar(speeds, "Ref", "speed") is speeds
    monkeypatch.setattr(sys, "stderr", Terminal())
    shown = bar(speeds, "Ref", "speed")
    assert shown is not speeds and list(shown) == speeds
    assert bar(speeds[:1], "Ref", "speed") == [1.0]


def test_names_are_imported_when_they_are_used():
    listed = [name for names in r37._NAMES_OF.values() for name in names]
    assert sorted([*listed, "__version__"]) == sorted(r37.__all__) == sorted(dir(r37))
    assert all(getattr(r37, name).__module__.startswith("r37") for name in listed if name != "SNAKEFILE")
    with pytest.raises(AttributeError, match="no attribute 'sweeps'"):
        _ = r37.sweeps


@pytest.mark.parametrize("name", ["__init__", "command", "study_folder", "stages", "docstrings"])
def test_a_word_that_computes_nothing_imports_nothing_that_computes(root, name):
    tree = ast.parse((root / f"src/r37/{name}.py").read_text())
    imports = [node for node in tree.body if isinstance(node, ast.Import | ast.ImportFrom)]
    names = {alias.name for node in imports if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in imports if isinstance(node, ast.ImportFrom)}
    assert {name.split(".")[0] for name in names} <= {*sys.stdlib_module_names, "r37", "r37core", "stages", "docstrings"}
    assert "r37core.config" not in names or name == "study_folder"


def test_words_that_compute_nothing_and_what_is_refused(root, capsys):
    config = str(root / "config/config.yaml")
    for words, said in {
        ("--version",): f"r37 {r37.__version__}\n",
        ("blades", "--config", config): "Ref\nL50\nL100\nS50\nS100\nCS50\nCS100\n",
        ("blades", str(root / "config/blades.yaml")): "Ref\nL50\nL100\nS50\nS100\nCS50\nCS100\n",
        ("scenes", "--config", config): "abradable\ndirect\nmaterial_abradable\nphysical_abradable\n",
        ("--print-completion", "bash"): "# AUTOMATICALLY GENERATED",
    }.items():
        try:
            assert main(words) == 0
        except SystemExit as end:
            assert end.code == 0
        assert capsys.readouterr().out.startswith(said), words
    with pytest.raises(SystemExit):
        main(["--print-completion", "ksh"])
    assert "found 'ksh'; allowed: bash, zsh" in capsys.readouterr().err
    assert main(["campbell", "mine.yaml", "--blades", "other.yaml"]) == 1
    assert capsys.readouterr().err == "r37: --blades: found other.yaml beside the file mine.yaml; allowed: one of them\n"


def test_the_command_takes_rpm_and_tells_a_warning_in_a_line(monkeypatch, capsys):
    """The level of the logger is what it was: the command may be called from Python."""

    def sweep(blade, scene, speeds, **_):
        assert speeds == [pytest.approx(1700.0)] and LOGGER.level == logging.WARNING
        raise r37.ConfigError("enough")

    monkeypatch.setattr("r37.sweep", sweep)
    assert main(["simulate", "Ref", "direct", f"{1700.0 / RAD_S['rpm']}", "--rpm", "--quiet"]) == 1
    assert capsys.readouterr().err == "r37: enough\n" and LOGGER.level == logging.NOTSET


def test_the_command_answers_in_the_unit_of_the_speeds(monkeypatch, capsys):
    values = {"rms_normal": (("speed", "tip_point"), [[1e-3]]), "rms_tangential": (("speed", "tip_point"), [[2e-3]])}
    found = xr.Dataset(values | {"status": ("speed", [0])}, {"speed": [1700.0], "tip_point": ["leading_edge"]})
    monkeypatch.setattr("r37.sweep", lambda *_, **__: found)
    assert main(["simulate", "Ref", "direct", "1700", "--quiet"]) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert lines[1:] == [["speed", "(rad/s)"], ["1700.0", "1", "2", "completed"]]
    assert main(["simulate", "Ref", "direct", f"{1700.0 / RAD_S['rpm']}", "--rpm", "--quiet"]) == 0
    head, name, row = capsys.readouterr().out.splitlines()
    assert head.split()[:2] == ["speed", "(rad/s)"] and name.strip() == "speed (rpm)"
    assert row.startswith("16233.80419") and row.split()[1:] == ["1700", "1", "2", "completed"]


@pytest.mark.parametrize("words", [["--print-completion", "bash"], ["blades"]])
def test_nobody_reads_on(words):
    """What is printed goes to a pipe that is closed: no traceback, and the status that a shell gives."""
    reading, writing = os.pipe()
    os.close(reading)
    command = f"import sys; from r37.command import main; sys.exit(main({words}))"
    done = subprocess.run([sys.executable, "-c", command], stdout=writing, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writing)
    assert (done.returncode, done.stderr) == (128 + signal.SIGPIPE, "")
