"""The fan blade of another program, judged by the commands of docs/assess.md, and of docs/measurement.md."""

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
    ),
    Item(
        "evidence.assess.measurement",
        {"table": table("measurement"), "picture": "docs/measurement.png"},
        params={"page": "docs/measurement.md"},
        sources=FAN,
        alone=True,
    ),
]
