"""All pictures of the site as a browser shows them: one sheet for a wide page and one for a phone, each light and dark.

Run after make site: python validation/contact_sheets.py [site [build/contact_sheets]]; needs Chromium.
"""

import io
import shutil
import sys
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

COLUMNS = {1400: 3, 390: 8}
"""Width of the page (px) -> pictures in a row of the sheet."""


def shots(browser, site, width, scheme):
    """Picture of every box with a picture, page by page."""
    page = browser.new_page(viewport={"width": width, "height": 1000}, color_scheme=scheme)
    for file in sorted(site.glob("*.html")):
        if 'class="picture ' in file.read_text(encoding="utf-8"):
            page.goto(file.as_uri())
            for box in page.locator(".picture:not(a *)").all():
                box.scroll_into_view_if_needed()
                box.locator("img").evaluate("image => image.decode()")
                yield Image.open(io.BytesIO(box.screenshot()))
    page.close()


def sheet(pictures, columns):
    """Pictures row by row, each in the column that has most room."""
    width = max(picture.width for picture in pictures) + 16
    columns = [[] for _ in range(columns)]
    for picture in pictures:
        min(columns, key=lambda column: sum(one.height + 16 for one in column)).append(picture)
    height = max(sum(one.height + 16 for one in column) for column in columns)
    whole = Image.new("RGB", (width * len(columns), height), "gray")
    for number, column in enumerate(columns):
        top = 8
        for picture in column:
            whole.paste(picture, (number * width + 8, top))
            top += picture.height + 16
    return whole


def main(site="site", folder="build/contact_sheets"):
    """Write the sheets and print their names."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        for width, columns in COLUMNS.items():
            for scheme in ("light", "dark"):
                file = Path(folder) / f"{width}_{scheme}.png"
                sheet(list(shots(browser, Path(site).resolve(), width, scheme)), columns).save(file)
                print(file)


if __name__ == "__main__":
    main(*sys.argv[1:])
