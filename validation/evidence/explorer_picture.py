"""Picture of the explorer's first screen as Chromium shows it: docs/explorer.png."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
# three-dimensional parts of the page, without a graphics card
SOFTWARE_GRAPHICS = ("--no-sandbox", "--enable-unsafe-swiftshader", "--use-gl=angle", "--use-angle=swiftshader")


def take(input: Any, output: Any, params: Any) -> None:
    """Take the picture, in light, at the interaction that the page opens at. Input: page. Output: picture."""
    # of the tests' packages, which only this step needs
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*SOFTWARE_GRAPHICS])
        page = browser.new_page(viewport={"width": 1200, "height": 1000}, color_scheme="light")
        page.goto(Path(input.page).resolve().as_uri())
        page.wait_for_selector("html[data-ready]", timeout=60_000)
        page.wait_for_timeout(1000)
        page.screenshot(path=output.picture)
        browser.close()
