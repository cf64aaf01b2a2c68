"""What the levels cost in accuracy (docs/accuracy.md), and which modes the stress counts."""

from evidence.blade_runs import CONFIGURATION, DECIDING_SOURCES
from evidence.plan import MADE, Item, table

from plan.runs import ALL_SPEEDS, BLADES, DECIDING

DRAWN = "S50"
PATCHES = {blade: f"{MADE}/accuracy_{blade}.csv" for blade in BLADES}
POINTS = {blade: f"{MADE}/accuracy_points_{blade}.csv" for blade in ("Ref", DRAWN)}
STEP = "evidence.accuracy.runs_of_blade"

EVIDENCE = [
    *(
        Item(
            STEP,
            {"runs": file},
            ALL_SPEEDS.models(blade),
            {"blade": blade, "configuration": DECIDING, "picture": blade == DRAWN},
            sources=DECIDING_SOURCES,
        )
        for blade, file in PATCHES.items()
    ),
    # the benchmark as it is published: linear, on points
    *(
        Item(STEP, {"runs": file}, {}, {"blade": blade, "configuration": {}, "picture": blade == DRAWN}, sources=CONFIGURATION)
        for blade, file in POINTS.items()
    ),
    Item(
        "evidence.accuracy.tables",
        {
            **{name: table(f"accuracy_{name}") for name in ("levels", "blades", "friction", "points")},
            "penetration": table("penetration"),
        },
        {"patches": list(PATCHES.values()), "points": list(POINTS.values())},
    ),
    Item(
        "evidence.accuracy.draw", {"picture": "docs/contact_patches.png"}, {"points": POINTS[DRAWN], "patches": PATCHES[DRAWN]}
    ),
    Item(
        "evidence.stress_band.table_and_picture",
        {"table": table("stress_band"), "picture": "docs/stress_band.png"},
        params={"configuration": DECIDING},
        sources=DECIDING_SOURCES,
    ),
]
