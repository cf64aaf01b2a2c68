"""The numbered examples run, at a small level in place of theirs, and what they assert holds."""

import shutil
from pathlib import Path

import pytest
from workflow_runs import copy_project, own_package

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.py"))


@pytest.fixture(scope="module")
def shipped(root, tmp_path_factory):
    """A package whose shipped configuration has a small level."""
    folder = tmp_path_factory.mktemp("shipped")
    copy_project(root, folder)
    shutil.copy(root / "config/scenes.yaml", folder / "config")
    own_package(folder)
    return folder / "src/r37"


def test_they_are_numbered_and_stand_on_a_page(root):
    assert [file.name[:3] for file in EXAMPLES] == [f"{number:02}_" for number in range(1, 6)]
    page = (root / "docs/gallery.md").read_text()
    for file in EXAMPLES:
        first = file.read_text().splitlines()[0]
        assert first.startswith(f'"""{int(file.name[:2])}. ') and f"](../examples/{file.name})" in page


@pytest.mark.slow
@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
def test_an_example_runs(shipped, warm_calls, monkeypatch, file):
    monkeypatch.setattr("r37.call_configuration._PACKAGE", shipped)
    monkeypatch.setattr("r37.study_folder._PACKAGE", shipped)
    text = file.read_text()
    small = text.replace('fidelity="draft"', 'fidelity="tiny"').replace("fidelity: draft", "fidelity: tiny")
    assert small != text
    exec(compile(small, file, "exec"), {"__name__": "__main__"})
