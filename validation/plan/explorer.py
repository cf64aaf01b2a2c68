"""The explorer of the main job: its picture, and its contents for the site (docs/site/explorer_page.py)."""

from evidence.plan import Item

from plan.runs import MAIN

EVIDENCE = [
    Item(
        "evidence.explorer_picture.picture",
        {"picture": "docs/explorer.png", "contents": "docs/site/explorer.json"},
        {"page": f"{MAIN.folder}/explorer.html"},
        program="chromium",
    )
]
