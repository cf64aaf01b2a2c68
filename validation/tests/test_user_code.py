"""Figures of docs/user_code.md: their programs run, at a small level and at few speeds, and stand on the page as they are."""

import re
import runpy

import matplotlib.pyplot as plt
import pytest
from conftest import CHECKOUT
from workflow_runs import copy_finished

PROGRAMS = 10


@pytest.fixture(scope="module")
def generator(root):
    return runpy.run_path(str(CHECKOUT / "validation/benchmarks/user_code.py"))


def test_the_page_has_the_programs_as_they_are(root, generator):
    """`python validation/benchmarks/user_code.py` renews it."""
    text = (root / "docs/user_code.md").read_text()
    assert text == generator["page"]()
    assert len(generator["FILES"]) == text.count("```python") == PROGRAMS
    for block in re.findall(r"```python\n(.*?)```", text, re.DOTALL):
        lines = [line for line in block.splitlines() if line and not line.startswith(("import", "from"))]
        assert len(lines) <= 10
        assert "r37core" not in block


@pytest.mark.slow
def test_the_programs_run(small_sweep, generator, tmp_path, monkeypatch):
    """All in one test: they share the structures that r37 keeps."""
    folder = copy_finished(small_sweep, tmp_path / "sweep")
    monkeypatch.setattr("r37.call_configuration._PACKAGE", folder)
    monkeypatch.setenv("R37_CACHE", str(folder / "cache"))
    for file in generator["FILES"]:
        small = re.sub(r'"step": \d+(, "refine_to": \d+)?', '"step": 100', file.read_text())
        small = small.replace('"draft"', '"tiny"').replace("cores=2", "cores=1").replace("members=16", "members=2")
        small = small.replace("[0, 25, 50, 75, 100]", "[50, 100]")
        names = {}
        exec(compile(small, file, "exec"), names)
        assert names["figure"].axes, file.name
    plt.close("all")
