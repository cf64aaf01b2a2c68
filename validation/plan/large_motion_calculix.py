"""Large motion against CalculiX (docs/large_motion.md)."""

from evidence.plan import Item, table

from plan.runs import BLADES, DECIDING

EVIDENCE = [
    Item(
        "evidence.large_motion_calculix.static",
        {"table": table("large_motion_calculix")},
        params={"configuration": DECIDING, "blades": BLADES},
        program="ccx",
    ),
    Item(
        "evidence.large_motion_calculix.decay",
        {"table": table("large_motion_decay")},
        params={"configuration": DECIDING, "blade": "Ref"},
        program="ccx",
    ),
]
