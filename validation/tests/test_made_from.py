"""What a committed file was made from: content decides whether it is out of date, layout and file times do not."""

import os

import pytest
from evidence.made_from import RECORD, MadeFrom
from evidence.pages import Pages, renewed

from r37core.base.io import read_json

TABLE, PAGE, ENGINE = "validation/tables/a.csv", "docs/a.md", "validation/engine_numbers.json"
FILES = {
    TABLE: "x\n1\n",
    PAGE: "<!-- table a -->\n<!-- end -->\n",
    "README.md": "",
    ENGINE: "{}",
    RECORD: "{}",
    "config/config.yaml": "scenes: [direct]\n",
    "validation/rules/a.smk": "rule a:\n    output:\n        'a.csv'\n",
    "validation/rules/runs.smk": "",
}


@pytest.fixture
def committed(tmp_path):
    """A folder with one table, whose record is that of now, and what says which of its files are out of date."""
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    (tmp_path / PAGE).write_text(renewed(FILES[PAGE], [tmp_path / TABLE]))

    def made_from(code="1"):
        return MadeFrom(tmp_path, {TABLE: (tmp_path / "validation/rules/a.smk", code)}, ENGINE, {})

    assert made_from().out_of_date(Pages(tmp_path)) == [TABLE]
    made_from().note([TABLE, "results/b.csv"])
    assert list(read_json(tmp_path / RECORD)) == [TABLE]
    return tmp_path, lambda code="1": made_from(code).out_of_date(Pages(tmp_path))


def test_times_and_layout_make_nothing_out_of_date(committed):
    folder, out_of_date = committed
    (folder / "validation/rules/a.smk").write_text("# one\nrule a:\n    output: 'a.csv'\n")
    (folder / "config/config.yaml").write_text("# two\nscenes:\n- direct\n")
    for number, name in enumerate([PAGE, *FILES]):
        os.utime(folder / name, (1e9 + number, 1e9 + number))
    assert out_of_date() == []
    # Snakemake compares the page with its table
    assert (folder / PAGE).stat().st_mtime > (folder / TABLE).stat().st_mtime


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("validation/rules/a.smk", FILES["validation/rules/a.smk"] + "    params: b=1\n"),
        ("validation/rules/runs.smk", "x = 1\n"),
        ("config/config.yaml", "scenes: [abradable]\n"),
        (ENGINE, "{1}"),
    ],
)
def test_other_content_makes_a_table_out_of_date(committed, name, text):
    folder, out_of_date = committed
    (folder / name).write_text(text)
    assert out_of_date() == [TABLE]


def test_a_configuration_that_no_rule_names_makes_nothing_out_of_date(committed):
    folder, out_of_date = committed
    (folder / "config/others.yaml").write_text("{}")
    assert out_of_date() == []
    (folder / "config/a.yaml").write_text("{}")
    assert out_of_date() == [TABLE]


def test_other_code_or_another_table_makes_out_of_date(committed):
    folder, out_of_date = committed
    assert out_of_date("2") == [TABLE]
    (folder / TABLE).write_text("x\n2\n")
    assert out_of_date() == [PAGE]
