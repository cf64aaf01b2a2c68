"""What runs cost (docs/speed.md)."""

from evidence.plan import Item, Run, table

from plan.runs import DECIDING

EVERY_SPEED = {"blades": ["Ref"], "speeds": [{"start": 750, "stop": 2000, "step": 2.5}], "estimate": {"every": 50}}

STANDARD = Run("estimate_standard", keys={**EVERY_SPEED, "fidelity": "standard"}, alone=True)
TO_DECIDE = Run("estimate_to_decide", keys={**DECIDING, **EVERY_SPEED}, alone=True)

NAMES = {"benchmark": STANDARD, "to decide from": TO_DECIDE}

EVIDENCE = [
    Item("evidence.speed.cost", {"table": table("cost")}, {name: f"{run.folder}/estimate.csv" for name, run in NAMES.items()})
]
