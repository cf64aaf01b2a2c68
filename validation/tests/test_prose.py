"""Sentences of README and docs/ are short, and their words the project's: benchmarks/prose.py measures, and says where."""

import runpy

import pytest
from conftest import CHECKOUT

PROSE = runpy.run_path(str(CHECKOUT / "validation/benchmarks/prose.py"))
PAGES = PROSE["pages"](CHECKOUT)


@pytest.mark.parametrize("page", PAGES)
def test_sentences_are_short(page):
    """At most 20 words on average, at most 12% of more than 30."""
    one = PROSE["prose"](PAGES[page])
    assert one.is_short, (
        f"{one.mean:.1f} words, {one.share_of_long:.1%} over {PROSE['LONG']}: python validation/benchmarks/prose.py {page}"
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


def test_long_pages_and_forbidden_words_are_told():
    long = " ".join(["Word"] * 31) + "."
    assert not PROSE["prose"](long).is_short
    assert PROSE["prose"]("Short. " * 8 + long).is_short
    assert PROSE["prose"]("Short. " * 7 + long).share_of_long == 0.125
    assert not PROSE["prose"]("Short. " * 7 + long).is_short
    said = "A dear step; it is slow, for it refines itself. Two readings."
    assert set(PROSE["forbidden"](said).values()) == {"expensive", "adaptive speed sampling", "modelling choice", "because"}
