"""Pages in headless Chromium, without a network: one browser for all that a process of the tests opens."""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from functools import cache

import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
QUIET = ("gpu", "quic", "background-networking", "component-update", "sync")
SOFTWARE_GRAPHICS = ("--enable-unsafe-swiftshader", "--use-gl=angle", "--use-angle=swiftshader")
"""For pages that draw in three dimensions, without a graphics card."""


_servers = []


def close():
    """End the browser of this process, if there is one."""
    for server in _servers:
        # Playwright's command is a process that waits for another
        os.killpg(server.pid, signal.SIGTERM)
        server.wait(20)
    _servers.clear()


@cache
def _address():
    """Of a browser that runs until `close`."""
    flags = ["--no-sandbox", "--no-first-run", *(f"--disable-{name}" for name in QUIET), *SOFTWARE_GRAPHICS]
    with tempfile.NamedTemporaryFile("w", suffix=".json") as settings:
        json.dump({"executablePath": CHROMIUM, "args": flags}, settings)
        settings.flush()
        command = [sys.executable, "-m", "playwright", "launch-server", "--browser", "chromium", "--config", settings.name]
        _servers.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True))
        return _servers[-1].stdout.readline().strip()


@contextmanager
def opened(file, viewport, kept=lambda message: True, place="", **more):
    """The page of a file, at a `place` in it (#...), with more arguments of a page.

    Its `problems`: errors and warnings of the console that are `kept`, requests to the network.
    """
    if CHROMIUM is None:
        pytest.skip("Chromium (apt-get install chromium)")
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright (make setup)")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.connect(_address())
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
        # of the connection alone
        browser.close()
