"""A search for a better blade (docs/better_blade.md)."""

from evidence.plan import Item, Run, table

# fewer designs and speeds than the overlay, and the scenes to decide by
SEARCH = Run(
    "search",
    ("search",),
    {
        "scenes_file": "validation/deciding.yaml",
        "speeds": [{"start": 1080, "stop": 1860, "step": 30}],
        "search": {"designs": 12},
    },
)

EVIDENCE = [
    Item("evidence.better_blade.best", {"table": table("better_blade")}, {"search": f"{SEARCH.folder}/search.nc"}),
    Item(
        "evidence.pictures.of_run",
        {"picture": "docs/search_designs.png"},
        {"figure": f"{SEARCH.folder}/figures/search_designs.png"},
    ),
]
