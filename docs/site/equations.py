"""Equations of the pages as SVG when the site is built: it shows them without scripts, fonts or a network.

MathML would do, too, but browsers draw its brackets and roots well only where a mathematical font is installed.
"""

from html import escape

from docutils.nodes import SkipNode
from sphinx.errors import SphinxError
from ziamath import Latex

INLINE_SIZE, DISPLAY_SIZE = 16.0, 18.0
"""Font sizes, px."""


def drawing(latex, inline):
    """A formula as an SVG element that takes the colour of the text around it.

    Raises SphinxError for a command of LaTeX that the converter does not know: it would stand in the picture as it is.
    """
    size = INLINE_SIZE if inline else DISPLAY_SIZE
    formula = Latex(latex, size=size, color="currentColor", inline=inline)
    if "\\" in formula.mathmlstr():
        raise SphinxError(f"no equation can be drawn of {latex!r}: use other commands of LaTeX")
    said = f'role="img" aria-label="{escape(latex)}" style="vertical-align: {formula.getyofst():.2f}px"'
    return formula.svg().replace("<svg ", f"<svg {said} ", 1)


def write_inline(translator, node):
    """A formula in a line."""
    translator.body.append(f'<span class="formula">{drawing(node.astext(), inline=True)}</span>')
    raise SkipNode


def write_block(translator, node):
    """A displayed equation."""
    translator.body.append(f'<div class="equation">{drawing(node.astext(), inline=False)}</div>')
    raise SkipNode


def setup(app):
    """Register this way to write equations with Sphinx."""
    app.add_html_math_renderer("svg", (write_inline, None), (write_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
