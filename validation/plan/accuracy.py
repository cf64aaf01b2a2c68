"""What the levels cost in accuracy (docs/accuracy.md), and which modes the stress counts."""

from evidence.plan import MADE, Item, table

from plan.runs import ALL_SPEEDS, BLADES, DECIDING

PATCHES = {blade: f"{MADE}/accuracy_{blade}.csv" for blade in BLADES}
FINE = {blade: {kind: f"{MADE}/fine/{blade}_{kind}.npz" for kind in ("contact", "stress")} for blade in BLADES}

EVIDENCE = [
    *(
        # the model of the finest mesh takes 3 GB and leaves no room for a run: first, while light items can go beside it
        Item(
            "evidence.accuracy.fine_models",
            models,
            params={"blade": blade, "configuration": DECIDING},
            priority=5,
            memory_mb=3600,
        )
        for blade, models in FINE.items()
    ),
    *(
        Item(
            "evidence.accuracy.runs_of_blade",
            {"runs": file},
            {"standard": list(ALL_SPEEDS.models(blade).values()), "fine": list(FINE[blade].values())},
            {"blade": blade, "configuration": DECIDING},
        )
        for blade, file in PATCHES.items()
    ),
    Item(
        "evidence.accuracy.tables",
        {**{name: table(f"accuracy_{name}") for name in ("levels", "blades", "friction")}, "penetration": table("penetration")},
        {"patches": list(PATCHES.values())},
    ),
    Item(
        "evidence.stress_band.table_and_picture",
        {"table": table("stress_band"), "picture": "docs/stress_band.png"},
        params={"configuration": DECIDING},
    ),
]
