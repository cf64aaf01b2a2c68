"""Numbers of the pages that are made by the scripts of validation/."""

import ast
import json
import re
import runpy

import pytest
from conftest import CHECKOUT

from r37core.text_file import part_of
from validation.published import INTERACTIONS
from validation.studies.modelling_choices.cases import CHOICES, SHIPPED, VARIED


def section(page, name):
    """What stands between a page's markers."""
    return part_of(page, name)


@pytest.fixture(scope="module")
def pages(root):
    tables = ("accuracy_tables", "stability_tables", "validation_tables")
    names = ("accuracy", "stability", "validation", "speed", *tables)
    return {name: (root / "docs" / f"{name}.md").read_text() for name in names}


@pytest.fixture
def claims(root, monkeypatch):
    """The package of the claims can be imported."""
    monkeypatch.syspath_prepend(str(CHECKOUT / "validation/benchmarks"))


def test_speed_page_has_the_measured_time_integration(root, pages, monkeypatch):
    monkeypatch.syspath_prepend(CHECKOUT / "validation/benchmarks")
    tables = runpy.run_path(str(CHECKOUT / "validation/benchmarks/integration_speed.py"))["tables"]
    measured = json.loads((CHECKOUT / "validation/benchmarks/integration_speed.json").read_text())
    assert section(pages["speed"], "integration_speed").strip() == tables(measured)


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


def test_every_extreme_has_an_outcome(pages):
    table = section(pages["stability_tables"], "stability")
    counted = re.match(r"(\d+) accurate, (\d+) degraded, (\d+) diverged, (\d+) refused, of (\d+) cases", table.strip())
    numbers = [int(number) for number in counted.groups()]
    assert sum(numbers[:4]) == numbers[4] == len(re.findall(r"\| (?:accurate|degraded|diverged|refused) \|", table)) > 90


def test_pages_say_what_their_long_tables_do(pages, claims):
    """What `make claims` writes on the page itself: the text before the table, and the rows that differ."""
    from claims.texts import summary

    for page, name in (("stability", "stability"), ("validation", "validation"), ("validation", "ranges")):
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
