"""The explorer of a finished run as Chromium shows it, and its contents, of which the site makes the page again."""

import json
import re
import shutil
from pathlib import Path
from typing import Any

from r37core.base.io import InputFileError, write_text

_WITHOUT_GRAPHICS_CARD = ("--no-sandbox", "--enable-unsafe-swiftshader", "--use-gl=angle", "--use-angle=swiftshader")


def picture(input: Any, output: Any, params: Any) -> None:
    """Picture of the first screen, at the run that the page opens at, and the contents without spectra.

    Input: page. Outputs: picture, contents. Raises InputFileError without Chromium.
    """
    # of the tests' packages, which only this step needs
    from playwright.sync_api import sync_playwright

    chromium = shutil.which("chromium")
    if chromium is None:
        raise InputFileError("chromium: not found; this picture needs it (on Debian: apt-get install chromium)")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=list(_WITHOUT_GRAPHICS_CARD))
        page = browser.new_page(viewport={"width": 1200, "height": 1000}, color_scheme="light")
        page.goto(Path(input.page).resolve().as_uri())
        page.wait_for_selector("html[data-ready]", timeout=60_000)
        page.wait_for_timeout(1000)
        page.screenshot(path=output.picture)
        browser.close()
    text = Path(input.page).read_text(encoding="utf-8")
    (data,) = re.findall(r'<script type="application/json" id="data">(.*)</script>', text)
    contents = json.loads(data)
    # three quarters of the file
    write_text(json.dumps(contents | {"spectrum": None}) + "\n", output.contents)
