"""What is seen in each figure: the one text that stands in the file itself, in the report and in the gallery."""

from __future__ import annotations

from r37core.figures import captions

from .extensions import EXTENSIONS

CAPTIONS: dict[str, str] = captions.CAPTIONS | {
    figure: text for extension in EXTENSIONS for figure, text in extension.captions.items()
}
"""Kind of figure -> text."""


def caption(figure: str, **names: str) -> str:
    """The caption of a kind of figure, with the names (blade, scene, family) of the one at hand."""
    return CAPTIONS[figure].format(**names)
