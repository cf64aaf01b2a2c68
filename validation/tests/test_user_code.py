"""Figures of docs/user_code.md: their programs run, at a small level and at few speeds, and stand on the page as they are."""

import re

import matplotlib.pyplot as plt
import pytest
from evidence.user_code import part
from workflow_runs import copy_finished

PROGRAMS = 10


@pytest.fixture(scope="module")
def programs(root):
    return sorted((root / "examples/figures").glob("*.py"))


def test_the_page_has_the_programs_as_they_are(root, programs):
    text = (root / "docs/user_code.md").read_text()
    assert text.endswith("\n".join(part(program) for program in programs))
    assert len(programs) == text.count("```python") == PROGRAMS
    for block in re.findall(r"```python\n(.*?)```", text, re.DOTALL):
        lines = [line for line in block.splitlines() if line and not line.startswith(("import", "from"))]
        assert len(lines) <= 10
        assert "r37core" not in block


@pytest.mark.slow
def test_the_programs_run(small_sweep, programs, tmp_path, monkeypatch):
    """All in one test: they share the structures that r37 keeps."""
    folder = copy_finished(small_sweep, tmp_path / "sweep")
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
