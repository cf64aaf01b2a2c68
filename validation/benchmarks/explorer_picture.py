"""docs/explorer.png: the explorer of a finished run as Chromium shows it. `python validation/benchmarks/explorer_picture.py [results]`."""

import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from browser import opened  # noqa: E402


def main(results: str = "results", picture: Path = ROOT / "docs/explorer.png") -> None:
    """Take the picture of the first screen, in light, at the interaction that the page opens at."""
    with opened(Path(results).resolve() / "explorer.html", {"width": 1200, "height": 1000}, color_scheme="light") as page:
        page.wait_for_selector("html[data-ready]", timeout=60_000)
        page.wait_for_timeout(1000)
        page.screenshot(path=picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
