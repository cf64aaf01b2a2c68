"""Pages in headless Chromium, without a network: one browser for all that a run of the tests opens, on however many cores."""

import fcntl
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

import pytest
from guard import RUN

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
QUIET = ("gpu", "quic", "background-networking", "component-update", "sync")

LONGEST = 600_000
"""What is waited for (ms), however busy the machine is."""

_KEPT = []


def close():
    """End the browser of this run of the tests, if there is one."""
    for file in Path(os.environ[RUN]).glob("browser.json"):
        # Playwright's command is a process that waits for another
        with suppress(ProcessLookupError):
            os.killpg(json.loads(file.read_text())[0], signal.SIGTERM)
    for server in _KEPT:
        server.wait(20)


@cache
def _address():
    """Of a browser that the first to need it starts; it runs until `close`."""
    file = Path(os.environ[RUN]) / "browser.json"
    with open(file.with_suffix(".lock"), "w") as lock:
        fcntl.lockf(lock, fcntl.LOCK_EX)
        if not file.exists():
            file.write_text(json.dumps(_start()))
    return json.loads(file.read_text())[1]


def _start():
    """Number of a process that is a browser, and its address."""
    flags = ["--no-sandbox", "--no-first-run", *(f"--disable-{name}" for name in QUIET)]
    with tempfile.NamedTemporaryFile("w", suffix=".json") as settings:
        json.dump({"executablePath": CHROMIUM, "args": flags}, settings)
        settings.flush()
        command = [sys.executable, "-m", "playwright", "launch-server", "--browser", "chromium", "--config", settings.name]
        _KEPT.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True))
        return _KEPT[-1].pid, _KEPT[-1].stdout.readline().strip()


@contextmanager
def opened(file, viewport, kept=lambda message: True, **more):
    """The page of a file, with more arguments of a page.

    Its `problems`: errors and warnings of the console that are `kept`, requests to the network.
    """
    if CHROMIUM is None:
        pytest.skip("Chromium (apt-get install chromium)")
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright (make setup)")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.connect(_address())
        page = browser.new_page(viewport=viewport, **more)
        page.set_default_timeout(LONGEST)
        page.problems = []

        def note(text):
            if kept(text):
                page.problems.append(text)

        page.on("console", lambda message: note(message.text) if message.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: note(str(error)))
        page.on("request", lambda request: None if request.url.startswith(("file:", "blob:", "data:")) else note(request.url))
        page.goto(file.as_uri())
        yield page
        # of the connection alone
        browser.close()
