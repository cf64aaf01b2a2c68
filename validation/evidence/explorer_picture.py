"""The explorer of a finished run as Chromium shows it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

_TESTS = Path(__file__).parents[2] / "tests"


def picture(input: Any, output: Any, params: Any) -> None:
    """Picture of the first screen, in light, at the interaction that the page opens at. Input: the page."""
    sys.path.insert(0, str(_TESTS))
    from browser import opened

    with opened(Path(input[0]).resolve(), {"width": 1200, "height": 1000}, color_scheme="light") as page:
        page.wait_for_selector("html[data-ready]", timeout=60_000)
        page.wait_for_timeout(1000)
        page.screenshot(path=output[0])
