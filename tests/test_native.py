"""Compiling: kept, shared by processes, and clear errors."""

import subprocess
import sys
from pathlib import Path

import pytest

from r37core import native
from r37core.native import CompilerError, load_library

TWICE = "#include <stdint.h>\nint64_t twice(int64_t x) { return FACTOR * x; }\n"


@pytest.fixture
def source(tmp_path):
    file = tmp_path / "twice.c"
    file.write_text(TWICE)
    return file


def test_compiled_once(source):
    assert load_library(source, {"FACTOR": 2}).twice(21) == 42
    assert load_library(source, {"FACTOR": 3}).twice(21) == 63
    libraries = sorted((source.parent / "__pycache__").iterdir())
    assert len(libraries) == 2
    before = [file.stat().st_mtime_ns for file in libraries]
    load_library(source, {"FACTOR": 2})
    assert [file.stat().st_mtime_ns for file in sorted((source.parent / "__pycache__").iterdir())] == before


def test_an_edited_source_is_compiled_again(source):
    assert load_library(source, {"FACTOR": 2}).twice(1) == 2
    source.write_text(TWICE.replace("FACTOR * x", "FACTOR * x + 1"))
    assert load_library(source, {"FACTOR": 2}).twice(1) == 3


def test_side_by_side(source):
    """Processes that compile the same library at once all get a whole one."""
    lines = [
        "from pathlib import Path",
        "from r37core.native import load_library",
        f"print(load_library(Path({str(source)!r}), {{'FACTOR': 5}}).twice(2))",
    ]
    command = "\n".join(lines)
    running = [subprocess.Popen([sys.executable, "-c", command], stdout=subprocess.PIPE, text=True) for _ in range(4)]
    assert [process.communicate()[0].strip() for process in running] == ["10"] * 4
    assert len(list((source.parent / "__pycache__").iterdir())) == 1


def test_no_compiler(source, monkeypatch):
    monkeypatch.setenv("CC", "no-such-compiler")
    with pytest.raises(CompilerError, match=r"'no-such-compiler' not found.*environment variable CC"):
        load_library(source, {"FACTOR": 2})


def test_an_error_of_the_compiler_is_shown_and_leaves_nothing(source):
    with pytest.raises(CompilerError, match=r"(?s)twice\.c.*FACTOR"):
        load_library(source, {})
    assert not list((source.parent / "__pycache__").iterdir())


def test_a_package_that_cannot_be_written(source, monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(native, "_writable", lambda _: False)
    assert load_library(source, {"FACTOR": 2}).twice(4) == 8
    assert len(list((tmp_path / "cache/r37").iterdir())) == 1


def test_the_c_sources_have_no_warnings(root):
    source = Path(root / "src/r37core/march/march.c")
    scene = ["LINING", "FRICTION", "EXACT_GAP", "LOSS"]
    for given in (0, 1):
        flags = [f"-DHAS_{name}={given}" for name in scene] + ["-DNODES=8", "-DCHUNKS=3", "-DCOARSE=8", "-DREAL=double"]
        command = [
            "cc",
            "-std=gnu11",
            "-O2",
            "-Wall",
            "-Wextra",
            "-Wno-psabi",
            "-fsyntax-only",
            f"-I{root / 'src/r37core'}",
            *flags,
            str(source),
        ]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        assert done.stderr == ""
