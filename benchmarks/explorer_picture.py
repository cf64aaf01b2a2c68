"""The explorer on the default sweep as a picture, of docs/results.md. Run: make claims ONLY=explorer; needs Chromium."""

import shutil
from pathlib import Path

from playwright.sync_api import sync_playwright

ROOT = Path(__file__).resolve().parent.parent
FILE = ROOT / "results/studies/figures/explorer.png"

if __name__ == "__main__":
    FILE.parent.mkdir(parents=True, exist_ok=True)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium") or shutil.which("google-chrome"), args=["--no-sandbox"]
        )
        page = browser.new_page(viewport={"width": 1200, "height": 1000})
        page.goto((ROOT / "results/explorer.html").as_uri())
        page.wait_for_load_state("networkidle")
        page.screenshot(path=FILE)
        browser.close()
