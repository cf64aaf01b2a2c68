"""Pictures of the pages, legible on a dark page and on a phone: there a wide one scrolls in a box of its own.

A table of pictures that are links shows them small (r37.css).
"""

from docutils.nodes import image
from PIL import Image

WIDTH = 72 * 9 / 7
"""Of an inch of a picture, px, at least: its letters of 7 points have 9 px then."""

RENDERED = 120
"""Dots per inch of a picture that does not say how many it has."""


def is_drawing(picture):
    """Whether a picture is lines and letters on white: few colours, most of it white. No rendering and no colour map."""
    area = picture.width * picture.height
    colours = sorted(picture.convert("RGB").getcolors(area), reverse=True)[:16]
    return colours[0][1] == (255, 255, 255) and colours[0][0] > area / 2 and sum(count for count, _ in colours) > 0.88 * area


def write(translator, node):
    """A picture in a box, with the size that it needs, loaded when it comes into view."""
    file, kind, size = translator.builder.srcdir / node["uri"], "drawing", ""
    # Sphinx warns of one that is not there
    if file.suffix == ".png" and file.exists():
        with Image.open(file) as picture:
            kind = "drawing" if is_drawing(picture) else "rendering"
            # drawn in grey on nothing, for any page
            if picture.mode == "RGBA" and picture.getpixel((0, 0))[3] == 0:
                kind = "transparent"
            least = min(picture.width / picture.info.get("dpi", [RENDERED])[0] * WIDTH, picture.width)
            size = f'width="{picture.width}" height="{picture.height}" style="min-width: {least:.0f}px"'
    type(translator).visit_image(translator, node)
    tag = translator.body[-1].strip().replace("<img ", f'<img loading="lazy" {size} ', 1)
    translator.body[-1] = f'<span class="picture {kind}">{tag}</span>'


def setup(app):
    """Write all pictures of the site this way."""
    app.add_node(image, override=True, html=(write, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
