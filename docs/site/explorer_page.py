"""The explorer of the shipped run: explorer.html of the site, of explorer.json next to this file."""

import json
from pathlib import Path

from r37core.explorer import write_page

CONTENTS = Path(__file__).parent / "explorer.json"
TITLE = "r37: the benchmark as published (make all_blades): seven linear blades, level standard; spectra are left out"


def write(app, exception):
    """Write the page."""
    if exception is None and CONTENTS.exists():
        write_page(json.loads(CONTENTS.read_text(encoding="utf-8")), TITLE, Path(app.outdir) / "explorer.html")


def setup(app):
    """Register it with Sphinx."""
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
