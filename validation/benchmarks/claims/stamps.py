"""Where an output carries the hash that it was made with: a table in its marker, a picture and a notebook in their metadata."""

from __future__ import annotations

import json
import re
from pathlib import Path

from PIL import Image
from PIL.PngImagePlugin import PngInfo

from r37core.io import atomic_write, write_text
from r37core.text_file import made_with_of, part_of, with_part

from .claim import Output

KEY = "Made with"
_OF_PAGE = re.compile(r"<!-- made-with:(\w+) -->\n\Z")


def read_stamp(output: Output, root: Path) -> str | None:
    """The hash that an output was made with, None where it carries none."""
    file = root / output.page
    if not file.exists():
        return None
    if file.suffix == ".png":
        with Image.open(file) as image:
            return image.text.get(KEY)
    text = file.read_text(encoding="utf-8")
    if file.suffix == ".ipynb":
        return json.loads(text)["metadata"].get("made_with")
    if output.marker:
        return made_with_of(text, output.marker)
    match = _OF_PAGE.search(text)
    return match and match[1]


def write_stamp(output: Output, made_with: str, root: Path) -> None:
    """Note in an output what it was made with; nothing else in it changes, and nothing at all where it says so."""
    if read_stamp(output, root) == made_with:
        return
    file = root / output.page
    if file.suffix == ".png":
        _stamp_picture(file, made_with)
        return
    text = file.read_text(encoding="utf-8")
    if file.suffix == ".ipynb":
        notebook = json.loads(text)
        notebook["metadata"]["made_with"] = made_with
        write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", file)
    elif output.marker:
        write_text(with_part(text, output.marker, part_of(text, output.marker), made_with), file)
    else:
        write_text(f"{_OF_PAGE.sub('', text)}<!-- made-with:{made_with} -->\n", file)


def _stamp_picture(file: Path, made_with: str) -> None:
    with Image.open(file) as image:
        about = PngInfo()
        for key, value in (image.text | {KEY: made_with}).items():
            about.add_text(key, value)
        with atomic_write(file) as partial:
            image.save(partial, "PNG", pnginfo=about, **({"dpi": image.info["dpi"]} if "dpi" in image.info else {}))
