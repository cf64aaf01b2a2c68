"""The lining by its material (docs/lining.md)."""

from evidence.plan import MADE, Item, table

from plan.runs import BLADES, DECIDING

LENGTHS = {blade: f"{MADE}/lining_contact_length_{blade}.csv" for blade in BLADES}

EVIDENCE = [
    Item(
        "evidence.lining.limits",
        {"table": table("lining_limits")},
        params={"configuration": DECIDING, "blades": ("Ref", "CS50")},
    ),
    *(
        Item("evidence.lining.contact_lengths_of_blade", {"lengths": file}, params={"configuration": DECIDING, "blade": blade})
        for blade, file in LENGTHS.items()
    ),
    Item(
        "evidence.lining.contact_lengths",
        {"table": table("lining_contact_length"), "picture": "docs/lining_contact_length.png"},
        {"files": list(LENGTHS.values())},
    ),
]
