"""A page in headless Chromium, without a network."""

import shutil
from contextlib import contextmanager

import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
QUIET = ("gpu", "quic", "background-networking", "component-update", "sync")
SOFTWARE_GRAPHICS = ("--enable-unsafe-swiftshader", "--use-gl=angle", "--use-angle=swiftshader")
"""Flags for pages that draw in three dimensions, without a graphics card."""


@contextmanager
def opened(file, viewport, kept=lambda message: True, flags=(), place="", **more):
    """The page of a file, at a `place` in it (#...), with more `flags` of the browser and arguments of a page.

    Its `problems`: errors and warnings of the console that are `kept`, requests to the network.
    """
    if CHROMIUM is None:
        pytest.skip("Chromium (apt-get install chromium)")
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright (make setup)")
    flags = ["--no-sandbox", "--no-first-run", *(f"--disable-{name}" for name in QUIET), *flags]
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=flags)
        page = browser.new_page(viewport=viewport, **more)
        page.problems = []

        def note(text):
            if kept(text):
                page.problems.append(text)

        page.on("console", lambda message: note(message.text) if message.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: note(str(error)))
        page.on("request", lambda request: None if request.url.startswith(("file:", "blob:", "data:")) else note(request.url))
        page.goto(file.as_uri() + place)
        yield page
        browser.close()
