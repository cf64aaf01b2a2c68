"""The project does not grow unnoticed: tokens of each package, of tests and validation, next to the numbers kept."""

import runpy

import pytest
from conftest import CHECKOUT

SIZE = runpy.run_path(str(CHECKOUT / "validation/size.py"))


@pytest.mark.parametrize("folder", SIZE["FOLDERS"])
def test_a_folder_keeps_its_size(folder):
    """Whoever raises a number of pyproject.toml lowers another one in the same commit."""
    assert SIZE["sizes"](CHECKOUT)[folder] <= (1 + SIZE["MARGIN"]) * SIZE["kept_sizes"](CHECKOUT)[folder], "make size"


def test_what_counts(tmp_path):
    file = tmp_path / "counted.py"
    file.write_text(
        '"""Docstring."""\n\n# comment\nX = "text"\n"""What X is."""\n\n\ndef f(a):\n    """More."""\n    return a + 1\n'
    )
    assert SIZE["tokens_of"](file) == len(["X", "=", "'text'", "def", "f", "(", "a", ")", ":", "return", "a", "+", "1"])
    (tmp_path / "src/r37").mkdir(parents=True)
    (tmp_path / "src/r37/linked.py").symlink_to(file)
    (tmp_path / "src/r37/own.py").write_text("x = 1\n")
    assert SIZE["sizes"](tmp_path)["src/r37"] == 3
