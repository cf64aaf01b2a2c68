"""Every figure says what is seen, in one text: in its file and in the report."""

import re

import matplotlib.pyplot as plt
from PIL import Image

from r37core.figures.style import save
from r37core.product.reporting import CAPTIONS, caption, captioned

NAMES = {"blade": "Ref", "scene": "direct", "family": "Sweep"}


def test_captions_are_filled_in_short_whole_sentences():
    for figure in CAPTIONS:
        text = caption(figure, **NAMES)
        assert "{" not in text and text.endswith("."), figure
        assert max(len(sentence.split()) for sentence in text.split(". ")) <= 30, figure


def test_every_figure_of_the_rules_has_a_caption_and_is_in_the_report(root):
    for name in ("figures", "designs", "shapes", "signals"):
        text = (root / f"workflow/rules/{name}.smk").read_text()
        rules = [block for block in re.split(r"^(?:use )?rule ", text, flags=re.MULTILINE) if "figures/" in block]
        assert rules
        for rule in rules[1:] if name == "figures" else rules:
            # `pictures` puts them into the report
            assert re.search(r"output:\s+(\*\*)?pictures\(", rule), rule
            kind = re.search(r'caption=captioned\("(\w+)"\)|drawing\(\s*"[\w.]+",\s*"(\w+)"', rule)
            assert "draw_map" in rule or (kind[1] or kind[2]) in CAPTIONS, rule
    functions = (root / "workflow/rules/common.smk").read_text()
    assert "report(" in functions.split("def shown(")[1].split("\n\n\n")[0]
    assert "shown(" in functions.split("def pictures(")[1].split("\n\n\n")[0]


def test_the_kind_of_a_map_is_a_wildcard():
    class Wildcards(dict):
        __getattr__ = dict.__getitem__

    assert captioned()(Wildcards(kind="wear", blade="Ref", scene="lined")) == caption("wear", blade="Ref", scene="lined")


def test_a_file_carries_its_caption(tmp_path):
    figure, _ = plt.subplots()
    save(figure, tmp_path / "a.png", caption("wear", **NAMES))
    assert Image.open(tmp_path / "a.png").text["Description"] == caption("wear", **NAMES)
