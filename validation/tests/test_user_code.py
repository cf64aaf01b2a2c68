"""Programs of examples/figures run, at a small level and at few speeds, and docs/gallery.md has each with its picture."""

import ast
import re

import matplotlib.pyplot as plt
import pytest
from workflow_runs import copy_project

PROGRAMS = 10


@pytest.fixture(scope="module")
def programs(root):
    return sorted((root / "examples/figures").glob("*.py"))


def test_the_gallery_links_each_program_with_its_picture(root, programs):
    text = (root / "docs/gallery.md").read_text()
    for program in programs:
        title = ast.get_docstring(ast.parse(program.read_text())).splitlines()[0].removesuffix(".")
        link = f"[{program.name}](../examples/figures/{program.name})"
        assert f"{link}\n\n![{title}](user_code/{program.stem}.png)\n" in text
    assert len(programs) == text.count("](user_code/") == PROGRAMS


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
