"""Every figure says what is seen, in one text: in its file and in the report."""

import re

import matplotlib.pyplot as plt
from PIL import Image

from r37core.figures.style import save
from r37core.product.reporting import FIGURES

NAMES = {"blade": "Ref", "scene": "direct", "family": "Sweep"}


def test_captions_are_filled_in_short_whole_sentences():
    for figure in FIGURES:
        text = figure.caption.format(**NAMES)
        assert "{" not in text and text.endswith("."), figure.rule
        assert max(len(sentence.split()) for sentence in text.split(". ")) <= 30, figure.rule


def test_every_figure_of_the_rules_has_a_caption_and_is_in_the_report(root):
    assert len({figure.rule for figure in FIGURES}) == len({figure.name for figure in FIGURES}) == len(FIGURES)
    for file in (root / "workflow/rules").glob("*.smk"):
        rules = re.split(r"^ *(?:use )?rule\b", file.read_text(), flags=re.MULTILINE)
        for rule in (block for block in rules[1:] if "/figures/" in block):
            # `pictures` puts them into the report
            assert re.search(r"output:\s+\*\*pictures\(", rule), rule
            assert "caption=" in rule or "drawing(figure, sweep)" in rule, rule
    functions = (root / "workflow/rules/common.smk").read_text()
    assert "report(" in functions.split("def shown(")[1].split("\n\n\n")[0]
    assert "shown(" in functions.split("def pictures(")[1].split("\n\n\n")[0]


def test_a_file_carries_its_caption(tmp_path):
    figure, _ = plt.subplots()
    save(figure, tmp_path / "a.png", "Wear of the lining.")
    assert Image.open(tmp_path / "a.png").text["Description"] == "Wear of the lining."
