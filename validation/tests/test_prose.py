"""Sentences of README and docs/ are short, and their words the project's: validation/prose.py measures, and says where."""

import runpy

import pytest
from conftest import CHECKOUT

PROSE = runpy.run_path(str(CHECKOUT / "validation/prose.py"))
PAGES = PROSE["pages"](CHECKOUT)


@pytest.mark.parametrize("page", PAGES)
def test_sentences_are_short(page):
    """At most 20 words on average, at most 12% of more than 30."""
    one = PROSE["prose"](PAGES[page])
    assert one.is_short, (
        f"{one.mean:.1f} words, {one.share_of_long:.1%} over {PROSE['LONG']}: python validation/prose.py {page}"
    )


@pytest.mark.parametrize("page", PAGES)
def test_words_are_those_of_the_project(page):
    assert not PROSE["forbidden"](PAGES[page])


def test_what_counts_as_a_sentence():
    page = """# A heading is none
A first one, with `some code in it`. A second one ends
on another line: [two words](link.md). Eng. Gas J. Turbines 12 is one.

- an item
- another, of 3.5 words? Yes!

| tables | none |
```sh
code none
```
<!-- made -->
Generated text is none.
<!-- end -->
![A picture](none.png)
"""
    assert PROSE["prose"](page).lengths == [5, 9, 1, 6, 2, 4, 1]


def test_the_source_of_a_number_is_no_word():
    assert PROSE["prose"]("It is 452<!--which_blade:Ref:lining--> rad/s, or 8<!--a:b:c:1-->%.").lengths == [6]
    assert PROSE["prose"]("One.\n\n<!-- table a: Ref -->\n| no |\n<!-- end -->\n\nTwo words.\n").lengths == [1, 2]


def test_long_pages_and_forbidden_words_are_told():
    long = " ".join(["Word"] * 31) + "."
    assert not PROSE["prose"](long).is_short
    assert PROSE["prose"]("Short. " * 8 + long).is_short
    assert PROSE["prose"]("Short. " * 7 + long).share_of_long == 0.125
    assert not PROSE["prose"]("Short. " * 7 + long).is_short
    said = "A dear step; it is slow, for it refines itself. Two readings."
    assert set(PROSE["forbidden"](said).values()) == {"expensive", "adaptive speed sampling", "modelling choice", "because"}


def test_pages_are_short():
    """28,000 words in all, 2,000 a page and seven rows a generated table, but for the page of the configuration."""
    texts = {name: text for name, text in PAGES.items() if name != "configuration.md"}
    lengths = {name: len(text.split()) for name, text in texts.items()}
    assert sum(lengths.values()) <= PROSE["MOST_WORDS"]
    assert {name: length for name, length in lengths.items() if length > PROSE["MOST_OF_A_PAGE"]} == {}
    assert {name: tables for name, text in texts.items() if (tables := PROSE["large_tables"](text))} == {}


def test_a_table_is_large_by_its_rows_or_columns():
    table, large = "<!-- table a: Ref -->\n| a | b |\n|---|---|\n{}<!-- end -->\n", PROSE["large_tables"]
    assert large(table.format(7 * "| 1 | 2 |\n")) == [] and large(table.format(8 * "| 1 | 2 |\n")) == ["a"]
    assert large(f"<!-- table b -->\n{9 * '| a '}|\n|---|\n<!-- end -->\n") == ["b"]


@pytest.mark.parametrize("page", PROSE["SOURCED"])
def test_numbers_of_answers_have_a_source(page):
    assert PROSE["unsourced"](PAGES[page], PROSE["configured"]()) == []


def test_a_number_without_a_source_is_found():
    page = "1. At 1B/4 of rotor 37, S50 has 452<!--a:b:c--> rad/s, 7 mm, `8` and\n0.356 mm; 1,200 of [12](13.md).\n"
    assert PROSE["unsourced"](page, {"0.356"}) == ["7", "1,200", "12"]
    assert {"0.356", "0.15", "1854", "0.3141"} - PROSE["configured"]() == {"0.3141"}


def test_docstrings_can_be_read_alone():
    assert PROSE["leaning_docstrings"]() == []


def test_what_leans(tmp_path):
    (tmp_path / "src").mkdir()
    text = '"""A module."""\nof_speed = 1\n"""Of the speed."""\n\n\n'
    text += 'def at_end():\n    """Those of it."""\n'
    (tmp_path / "src/one.py").write_text(text)
    assert PROSE["leaning_docstrings"](tmp_path) == ["src/one.py:3: Of the speed.", "src/one.py:7: Those of it."]
