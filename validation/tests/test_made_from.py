"""Whether a committed file is out of date: its content and what it is made from decide, layout and times do not.

And which items and runs go beside each other.
"""

import os
import re
import sys
from pathlib import Path

import pytest
from conftest import CHECKOUT
from evidence import plan as plans
from evidence.made_from import RECORD, note, out_of_date
from evidence.pages import renewed
from evidence.plan import ENGINE, Item, Plan, Run, used

from r37core.base.io import read_json

TABLE, PAGE = "validation/tables/a.csv", "docs/a.md"
FILES = {
    TABLE: "x\n1\n",
    PAGE: "<!-- table a -->\n<!-- end -->\n",
    "README.md": "",
    ENGINE: "{}",
    RECORD: "{}",
    "validation/tables/columns.csv": "",
    "docs/source.py": "1",
    **{f"config/{name}.yaml": "a: 1\n" for name in ("blades", "config", "fidelity", "scenes")},
    "validation/plan/a.py": "",
    "validation/evidence/__init__.py": "",
    "validation/step.py": "",
    "validation/evidence/steps.py": "def first(input, output, params):\n    return 1\n\ndef other(): return 2\n",
}


@pytest.fixture
def committed(tmp_path, monkeypatch):
    """A folder with one table, made of a run and another item, and what says which of its files are out of date."""
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    (tmp_path / PAGE).write_text(renewed(FILES[PAGE], [tmp_path / TABLE]))
    contents = {"fan": {"speeds": [1]}}
    monkeypatch.setattr(Run, "content", property(lambda run: contents[run.name]))

    def changed(step="evidence.steps.first", speeds=(1,), between="evidence.steps.first", more=()):
        contents["fan"] = {"speeds": list(speeds)}
        middle = Item(between, {"file": "results/evidence/b.csv"}, {"run": "results/runs/fan/ranking.csv"})
        last = Item(step, {"table": TABLE}, {"files": "results/evidence/b.csv"}, sources=["docs/source.py"])
        module = type(sys)("plan.a")
        module.FAN, module.EVIDENCE = Run("fan"), [middle, last, *more]
        monkeypatch.setattr(plans, "import_module", lambda name: module)
        return Plan(tmp_path)

    assert list(out_of_date(changed())) == [TABLE]
    note(changed(), [TABLE, "results/evidence/b.csv"])
    assert list(read_json(tmp_path / RECORD)) == [TABLE]
    return tmp_path, changed


def test_times_layout_and_other_items_make_nothing_out_of_date(committed):
    folder, plan = committed
    (folder / "config/config.yaml").write_text("# one\na:\n  1\n")
    (folder / "validation/evidence/steps.py").write_text(FILES["validation/evidence/steps.py"].replace("2", "3") + "# more\n")
    for number, name in enumerate([PAGE, *FILES]):
        os.utime(folder / name, (1e9 + number, 1e9 + number))
    more = Item("evidence.steps.other", {"file": "results/evidence/c.csv"}, {"run": "results/runs/fan/summary.csv"})
    assert out_of_date(plan(more=[more])) == {}


@pytest.mark.parametrize(
    "change", [{"step": "evidence.steps.other"}, {"speeds": (1, 2)}, {"between": "evidence.steps.other"}], ids=str
)
def test_what_an_item_uses_makes_it_out_of_date(committed, change):
    assert list(out_of_date(committed[1](**change))) == [TABLE]


@pytest.mark.parametrize(
    ("name", "text"), [(ENGINE, '{"a": 1}'), ("config/config.yaml", "a: 2\n"), ("docs/source.py", "2"), (TABLE, "x\n2\n")]
)
def test_a_change_of_a_file_makes_it_out_of_date(committed, name, text):
    folder, plan = committed
    (folder / name).write_text(text)
    assert TABLE in out_of_date(plan())


def test_a_page_with_other_numbers_and_a_table_that_nothing_makes_are_named(committed):
    folder, plan = committed
    (folder / PAGE).write_text("<!-- table a -->\n<!-- end -->\n[b](../validation/tables/b.csv)\n")
    assert set(out_of_date(plan())) == {PAGE, "validation/tables/b.csv"}


def test_a_run_uses_the_entries_that_it_names_and_their_bases():
    entries = {"a": {"base": "b"}, "b": {}, "c": {}}
    assert [name for name, _ in used(entries, ["a"])] == ["a", "b"]
    assert used(entries, "c") == [("c", {})]
    # those of a family have other names
    assert used(entries, ["a", "c_0p1"]) == used(entries, "all") == sorted(entries.items())


def test_what_needs_a_program_that_is_missing_is_left_out(committed):
    more = [Item("evidence.steps.other", {"file": f"results/evidence/{name}.csv"}, program=name) for name in ("no_such", "sh")]
    assert committed[1](more=more).without_program() == {"no_such": "no_such"}


def test_what_goes_beside_what(monkeypatch):
    """Two runs of the product go at a time, or a model of the finest mesh and a light item; what uses all cores goes alone."""
    monkeypatch.chdir(CHECKOUT)
    plan, makefile = Plan(), Path("Makefile").read_text()
    (memory,) = map(int, re.findall(r"--resources mem_mb=(\d+) ", makefile))
    modules = {name: item.step.split(".")[1] for name, item in plan.items.items()}
    alone = {name for name, module in modules.items() if module in ("assess", "tutorial", "user_code")}
    alone |= {"product_estimate_benchmark", "product_estimate_to_decide", "cost_growth", "cost_of_studies"}
    threads = {name: plan.threads(name, 8) for name in [*modules, *(f"product_{name}" for name in plan.runs)]}
    assert {name for name, count in threads.items() if count == 8} == alone
    assert {name for name, count in threads.items() if count == 4} == {f"product_{name}" for name in plan.runs} - alone
    finest, run, light = (plan.part(name).memory_mb for name in ("Ref_contact", "product_", "rotor_kinds"))
    assert f"--resources mem_mb={memory}" in Path("docs/site/table_pages.py").read_text()
    assert max(finest + light, 2 * run) <= memory < min(finest + run, 2 * finest, 3 * run)
    assert plan.threads("product_", 1) == 1
    first = [
        plan.part(name).priority for name in ("Ref_contact", "product_which_blade", "product_rotors", "product_", "blades")
    ]
    assert first == sorted(set(first), reverse=True)
