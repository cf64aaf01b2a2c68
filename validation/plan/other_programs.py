"""The time integration against a program that shares no code with it (docs/validation.md)."""

from evidence.plan import Item, table

from plan.runs import MAIN

MODELS = {blade: f"{MAIN.folder}/{blade}/contact_pressure_edge.npz" for blade in ("Ref", "CS50")}

EVIDENCE = [
    Item("evidence.other_programs.elastic", {"table": table("other_programs_elastic")}, {"model": MODELS["Ref"]}),
    Item("evidence.other_programs.material", {"table": table("other_programs_material")}, MODELS),
]
