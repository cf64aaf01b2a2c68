"""The fan blade of another program, judged and attacked by the commands of docs/assess.md."""

from pathlib import Path

from evidence.plan import Item, table

FAN = sorted(str(file) for file in Path("examples/fan").iterdir() if file.is_file())

EVIDENCE = [
    Item(
        "evidence.assess.verdicts",
        {"table": table("assess"), "map": "docs/assess_map.png", "stress": "docs/assess_stress.png"},
        params={"page": "docs/assess.md"},
        sources=FAN,
        alone=True,
    )
]
