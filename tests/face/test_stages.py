"""What calls and the command say while they work, and how quickly the command starts."""

import io
import logging
import os
import signal
import subprocess
import sys
import warnings

import pytest
from conftest import Terminal

import r37
from r37.command import main
from r37.stages import LOGGER, bar, stages


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


def test_the_version_and_two_files_of_blades(capsys):
    with pytest.raises(SystemExit, match="0"):
        main(["--version"])
    assert capsys.readouterr().out == f"r37 {r37.__version__}\n"
    assert main(["campbell", "mine.yaml", "--blades", "other.yaml"]) == 1
    assert capsys.readouterr().err == "r37: --blades: found other.yaml beside the file mine.yaml; allowed: one of them\n"


def test_the_command_tells_a_warning_in_a_line(monkeypatch, capsys):
    def campbell(*_, **__):
        warnings.warn("slow", stacklevel=1)
        raise r37.ConfigError("enough")

    monkeypatch.setattr("r37.campbell", campbell)
    assert main(["campbell", "Ref"]) == 1
    assert capsys.readouterr().err == "r37: slow\nr37: enough\n"


def test_nobody_reads_on():
    """What is printed goes to a pipe that is closed: no traceback, and the status that a shell gives."""
    reading, writing = os.pipe()
    os.close(reading)
    command = "import sys; from r37.command import main; sys.exit(main(['check']))"
    done = subprocess.run([sys.executable, "-c", command], stdout=writing, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writing)
    assert (done.returncode, done.stderr) == (128 + signal.SIGPIPE, "")
