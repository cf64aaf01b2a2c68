"""Puts the tables and pictures of the studies into the pages of docs/. Run: make docs (after that, read the difference).

A page says where with <!-- name --> ... <!-- end -->.
"""

import shutil
from pathlib import Path

ROOT = Path(__file__).parent.parent
STUDIES = ROOT / "results" / "studies"
TABLES = {
    "accuracy": {"levels": "levels.md", "tradeoff": "tradeoff.md", "growth": "growth.md"},
    "stability": {"stability": "stability.md"},
    "validation": {"validation": "validation.md", "readings": "readings.md"},
    "speed": {"estimate": "estimate.md"},
}
PICTURES = (
    "tradeoff_pareto",
    "growth",
    "readings",
    *(f"validation_{name}" for name in ("reference", "blades", "stress", "histories", "spectrum_lined", "spectrum_direct")),
)


def fill(page, name, text):
    """Replace what stands between the page's markers of this name."""
    before, rest = page.read_text(encoding="utf-8").split(f"<!-- {name} -->\n", 1)
    after = rest.split("<!-- end -->", 1)[1]
    page.write_text(f"{before}<!-- {name} -->\n{text.rstrip()}\n<!-- end -->{after}", encoding="utf-8")


def main():
    for page, tables in TABLES.items():
        for name, file in tables.items():
            if (STUDIES / file).exists():
                fill(ROOT / "docs" / f"{page}.md", name, (STUDIES / file).read_text(encoding="utf-8"))
    for picture in PICTURES:
        file = STUDIES / "figures" / f"{picture}.png"
        if file.exists():
            shutil.copy(file, ROOT / "docs" / file.name)


if __name__ == "__main__":
    main()
