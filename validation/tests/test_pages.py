"""Tables and pictures of README and docs/: each is an output of a rule, and a page has the content of its tables."""

import ast
import re
import shutil

import pytest
from conftest import CHECKOUT
from evidence.configuration import settings_of
from evidence.pages import Pages, markdown, renewed
from evidence.tables import read_table, write_table
from workflow_runs import snakemake

from r37core.config.remarks import remarks_at_end

PAGES = Pages(CHECKOUT)


@pytest.mark.parametrize("page", PAGES.files)
def test_a_page_has_the_content_of_its_tables(page):
    """`snakemake -s validation/Snakefile` puts them there."""
    text = (CHECKOUT / page).read_text()
    assert renewed(text, [CHECKOUT / file for file in PAGES.tables(page)]) == text


def test_tables_are_linked_or_shown():
    tables = {str(file.relative_to(CHECKOUT)) for file in (CHECKOUT / "validation/tables").glob("*.csv")}
    assert tables == set(PAGES.all_tables)


def test_pictures_stand_on_a_page():
    pictures = {str(file.relative_to(CHECKOUT)) for file in (CHECKOUT / "docs").rglob("*.png")}
    assert {file for file in pictures if not file.startswith("docs/site/")} == set(PAGES.pictures)


def test_a_table_in_a_page(tmp_path):
    file = tmp_path / "rates.csv"
    write_table(["blade", "rate, up"], [["Ref", "1 | 2"], ["S100", ""]], file)
    assert read_table(file) == [["blade", "rate, up"], ["Ref", "1 | 2"], ["S100", ""]]
    page = "Before.\n\n<!-- table rates -->\nold\n<!-- end -->\n\nAfter.\n"
    assert renewed(page, [file]) == page.replace("old\n", markdown(read_table(file)))
    assert markdown(read_table(file)).splitlines()[1:3] == ["|---|---|", r"| Ref | 1 \| 2 |"]


def test_numbers_in_sentences_come_from_tables(tmp_path):
    file = tmp_path / "rates.csv"
    write_table(["blade", "scene", "rate, up (m/s)"], [["S50", "bare casing", "-1.5 (2)"], ["S50", "lined", "3,100"]], file)
    page = "It is 1<!--rates:S50+bare_casing:rate_up_m_s--> m/s, rank 9<!--rates:S50:rate_up_m_s:1-->"
    page += ", or 7<!--rates:S50+lined:rate_up_m_s-->."
    new = renewed(page, [file])
    assert re.sub("<!--.*?-->", "", new) == "It is -1.5 m/s, rank 2, or 3,100."
    assert renewed(new, [file]) == new
    for wrong in ("rates:S100:rate_up_m_s", "rates:S50:rate", "rates:S50:rate_up_m_s:2"):
        with pytest.raises(ValueError, match="no such row"):
            renewed(f"1<!--{wrong}-->", [file])


def test_a_page_shows_some_rows_of_a_table(tmp_path):
    file = tmp_path / "rates.csv"
    write_table(["blade", "rate"], [["Ref", "1"], ["L50", "2"], ["S100", "3"]], file)
    page = renewed("<!-- table rates: Ref; S100 -->\n<!-- end -->\n", [file])
    assert page.splitlines()[3:5] == ["| Ref | 1 |", "| S100 | 3 |"]
    assert (
        renewed("<!-- lines rates: L50 -->\n<!-- end -->\n", [file])
        == "<!-- lines rates: L50 -->\n```text\n2\n```\n<!-- end -->\n"
    )


def test_pages_name_their_tables_and_pictures(tmp_path):
    (tmp_path / "docs").mkdir()
    (tmp_path / "README.md").write_text("![A](docs/a.png)\n[all rows](validation/tables/b.csv)\n")
    text = "4<!--e:Ref:rate-->\n<!-- table c -->\n<!-- end -->\n![B](gallery/b.png) [all](../validation/tables/d.csv)\n"
    (tmp_path / "docs/one.md").write_text(text)
    pages = Pages(tmp_path)
    assert pages.files == ["docs/one.md"] and pages.tables("docs/one.md") == [f"validation/tables/{name}.csv" for name in "ce"]
    assert pages.all_tables == [f"validation/tables/{name}.csv" for name in "bcde"]
    assert pages.pictures == ["docs/a.png", "docs/gallery/b.png"]


def test_mutants_are_of_modules_and_tests_that_are_there():
    text = (CHECKOUT / "validation/mutants.py").read_text()
    modules = ast.literal_eval(re.search(r"^TESTS = (\{.*?^\})", text, re.MULTILINE | re.DOTALL)[1])
    assert [name for name in modules if not [*CHECKOUT.glob(f"src/*/{name}")]] == []
    assert [name for names in modules.values() for name in names.split() if not [*CHECKOUT.glob(f"tests/*/{name}")]] == []


NOT_MADE_HERE = {"columns", "modelling_choices_v0_2"}
"""Tables of the code (evidence.key_tables), and of an older tag (docs/validation.md)."""


@pytest.mark.slow
def test_every_table_and_picture_has_a_rule(tmp_path):
    """A plan without any of them asks for nothing that no rule makes."""
    made = {*PAGES.pictures, *PAGES.all_tables} - {f"validation/tables/{name}.csv" for name in NOT_MADE_HERE}
    for folder in ("config", "docs", "envs", "examples", "profiles", "validation", "workflow"):
        shutil.copytree(CHECKOUT / folder, tmp_path / folder, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("README.md", "Snakefile"):
        shutil.copy(CHECKOUT / name, tmp_path)
    (tmp_path / "src").symlink_to(CHECKOUT / "src")
    for file in made:
        (tmp_path / file).unlink(missing_ok=True)
    snakemake(tmp_path, "-s", "validation/Snakefile", "-n", "--quiet", "all")


def test_the_remark_on_rigid_casings_has_the_numbers_of_the_table():
    """The worse of two blades, in the region that decides."""
    rows = {tuple(row[:2]): row[4] for row in read_table(CHECKOUT / "validation/tables/stress_band.csv")}
    usual, elastic = (rows["S100, bare, 1867 rad/s", case] for case in ("as shipped", "elastic casing"))
    remark = next(text for text in remarks_at_end(settings_of(CHECKOUT, scenes=["direct"])) if "rigid" in text)
    assert f"of S100 at 1867 rad/s from {usual} to {elastic} times yield" in remark
