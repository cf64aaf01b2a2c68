"""An interaction under tolerances (docs/tolerances.md)."""

from evidence.plan import Item, Run, table

from plan.runs import ALL_SPEEDS

# fewer speeds, for a wide interaction
MEMBERS = Run(
    "tolerances",
    ("tolerances",),
    {
        "blades": ["Ref", "CS100"],
        "fidelity": "draft",
        "speeds": [{"start": 1660, "stop": 1888, "step": 12}],
        "speeds_for": [{"blades": ["CS100"], "speeds": [{"start": 1348, "stop": 1548, "step": 12}]}],
    },
)

EVIDENCE = [
    Item(
        "evidence.tolerances.ranges",
        {"table": table("tolerance_ranges")},
        {
            "table": f"{MEMBERS.folder}/tolerances.csv",
            "members": f"{MEMBERS.folder}/tolerances.nc",
            "campbell": f"{ALL_SPEEDS.folder}/campbell.nc",
        },
        {"mode": "1B", "order": 4},
    ),
    Item("evidence.tolerances.numbers", {"table": table("tolerance_numbers")}, {"members": f"{MEMBERS.folder}/tolerances.nc"}),
    Item(
        "evidence.pictures.of_run",
        {"picture": "docs/tolerances_Ref.png"},
        {"figure": f"{MEMBERS.folder}/figures/tolerances_Ref__material_abradable.png"},
    ),
]
