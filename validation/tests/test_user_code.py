"""Programs of examples/figures run, at a small level and at few speeds, and docs/gallery.md links each."""

import re

import matplotlib.pyplot as plt
import pytest
from workflow_runs import copy_project


@pytest.fixture(scope="module")
def programs(root):
    return sorted((root / "examples/figures").glob("*.py"))


def test_the_gallery_links_each_program_and_shows_some_pictures(root, programs):
    text = (root / "docs/gallery.md").read_text()
    assert [file.name for file in programs if f"](../examples/figures/{file.name})" not in text] == []
    shown = sorted((root / "docs/user_code").glob("*.png"))
    assert [file.stem for file in shown if f"(../examples/figures/{file.stem}.py)\n\n![" not in text] == []


def test_the_programs_are_short_and_call_r37_alone(programs):
    for program in programs:
        code = program.read_text().split('"""', 2)[2]
        lines = [line for line in code.splitlines() if line and not line.startswith(("import", "from"))]
        assert len(lines) <= 10
        assert "r37core" not in code


@pytest.mark.slow
def test_the_programs_run(root, warm_calls, programs, tmp_path, monkeypatch):
    """All in one test: they share the structures that r37 keeps."""
    folder = tmp_path / "small"
    copy_project(root, folder)
    monkeypatch.setattr("r37.call_configuration._PACKAGE", folder)
    monkeypatch.setenv("R37_CACHE", str(folder / "cache"))
    for file in programs:
        small = re.sub(r'"step": \d+(, "refine_to": \d+)?', '"step": 100', file.read_text())
        small = small.replace('"draft"', '"tiny"').replace("cores=2", "cores=1").replace("members=16", "members=2")
        small = small.replace("[0, 25, 50, 75, 100]", "[50, 100]")
        names = {}
        exec(compile(small, file, "exec"), names)
        assert names["figure"].axes, file.name
    plt.close("all")
