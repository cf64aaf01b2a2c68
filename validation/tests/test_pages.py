"""Tables and pictures of README and docs/: each is an output of a rule, and a page has the content of its tables."""

import ast
import re

import pytest
from conftest import CHECKOUT
from evidence.pages import Pages, markdown, read_table, renewed, write_table

PAGES = Pages(CHECKOUT)


@pytest.mark.parametrize("page", PAGES.files)
def test_a_page_has_the_content_of_its_tables(page):
    """`snakemake -s validation/Snakefile` puts them there."""
    text = (CHECKOUT / page).read_text()
    assert renewed(text, [CHECKOUT / file for file in PAGES.tables(page)]) == text


<<<<<<< HEAD
def test_tables_are_linked_or_shown():
    tables = {str(file.relative_to(CHECKOUT)) for file in (CHECKOUT / "validation/tables").glob("*.csv")}
    assert tables == set(PAGES.all_tables)
=======
@pytest.fixture(scope="module")
def pages(root):
    return {name: (root / "docs" / f"{name}.md").read_text() for name in ("validation", "validation_tables")}
>>>>>>> 7ff6651 (Levels, steep places and outcomes as short tables that README and pages take; tests of accuracy, adaptive speeds, extremes)


def test_pictures_stand_on_a_page():
    pictures = {str(file.relative_to(CHECKOUT)) for file in (CHECKOUT / "docs").rglob("*.png") if "site" not in file.parts}
    assert pictures == set(PAGES.pictures)


<<<<<<< HEAD
def test_a_table_in_a_page(tmp_path):
    file = tmp_path / "rates.csv"
    write_table(["blade", "rate, up"], [["Ref", "1 | 2"], ["S100", ""]], file)
    assert read_table(file) == [["blade", "rate, up"], ["Ref", "1 | 2"], ["S100", ""]]
    page = "Before.\n\n<!-- table rates -->\nold\n<!-- end -->\n\nAfter.\n"
    assert renewed(page, [file]) == page.replace("old\n", markdown(read_table(file)))
    assert markdown(read_table(file)).splitlines()[1:3] == ["|---|---|", r"| Ref | 1 \| 2 |"]
    with pytest.raises(ValueError):
        renewed(page, [tmp_path / "other.csv"])


def test_pages_name_their_tables_and_pictures(tmp_path):
    (tmp_path / "docs").mkdir()
    (tmp_path / "README.md").write_text("![A](docs/a.png)\n[all rows](validation/tables/b.csv)\n")
    (tmp_path / "docs/one.md").write_text("<!-- table c -->\n<!-- end -->\n![B](gallery/b.png) [all](../validation/tables/d.csv)\n")
    pages = Pages(tmp_path)
    assert pages.files == ["docs/one.md"] and pages.tables("docs/one.md") == ["validation/tables/c.csv"]
    assert pages.all_tables == [f"validation/tables/{name}.csv" for name in "bcd"]
    assert pages.pictures == ["docs/a.png", "docs/gallery/b.png"]


def test_mutants_are_of_modules_and_tests_that_are_there():
    text = (CHECKOUT / "validation/mutants.py").read_text()
    modules = ast.literal_eval(re.search(r"^TESTS = (\{.*?^\})", text, re.MULTILINE | re.DOTALL)[1])
    assert [name for name in modules if not (CHECKOUT / "src/r37core" / name).exists()] == []
    assert [name for names in modules.values() for name in names.split() if not (CHECKOUT / "tests" / name).exists()] == []
=======
def test_mutants_are_of_modules_and_tests_that_are_there(root):
    text = (CHECKOUT / "validation/benchmarks/mutants.py").read_text()
    modules = ast.literal_eval(re.search(r"^TESTS = (\{.*?^\})", text, re.MULTILINE | re.DOTALL)[1])
    assert [name for name in modules if not (root / "src/r37core" / name).exists()] == []
    here = CHECKOUT / "tests"
    assert [name for names in modules.values() for name in names.split() if not (here / name).exists()] == []


def test_validation_page_has_every_interaction_and_every_modelling_choice(pages):
    rows = section(pages["validation_tables"], "validation").splitlines()
    for one in INTERACTIONS:
        start = f"| {one.blade} 1B/{one.engine_order}: peak | {one.peak:g} rad/s |"
        assert any(row.startswith(start) for row in rows), start
    choices = section(pages["validation"], "modelling_choices")
    assert all(f"| {CHOICES[name].what} |" in choices for name in (SHIPPED, *VARIED))


def test_pages_say_what_their_long_tables_do(pages, claims):
    """What `make claims` writes on the page itself: the text before the table, and the rows that differ."""
    from claims.texts import summary

    for page, name in (("validation", "validation"), ("validation", "ranges")):
        assert section(pages[page], name).strip() == summary(section(pages[f"{page}_tables"], name)), (page, name)


def test_a_summary_has_the_rows_that_differ(claims):
    from claims.texts import summary

    table = "2 of 3 agree.\n\n| what | ours |\n|---|---|\n| a | **2** |\n| b | 3 |\n\nAfter it.\n"
    assert summary(table) == "2 of 3 agree.\n\n| what | ours |\n|---|---|\n| a | **2** |"
    assert summary(table.replace("**", "")) == "2 of 3 agree."


@pytest.mark.slow
def test_rule_graph_is_that_of_the_workflow(root, claims):
    """`make claims ONLY=rules` renews it."""
    from claims.rule_graph import rule_graph

    assert section((root / "docs/architecture.md").read_text(), "rules").strip() == rule_graph()
>>>>>>> 7ff6651 (Levels, steep places and outcomes as short tables that README and pages take; tests of accuracy, adaptive speeds, extremes)
