"""What a flexible casing changes (docs/elastic_casing.md)."""

from evidence.plan import Item, Run, table

from plan.runs import DECIDING

SCENES = tuple(f"{contact}_{casing}" for contact in ("lined", "bare") for casing in ("rigid", "stiff", "soft"))
BLADES = ("Ref", "S50")
SPEEDS = {"start": 800, "stop": 2000, "step": 100}
DRAWN = ("Ref", "bare_stiff")

CASINGS = Run(
    "elastic_casing",
    keys={
        **DECIDING,
        "blades": list(BLADES),
        "scenes_file": "validation/casings.yaml",
        "scenes": list(SCENES),
        "speeds": [SPEEDS],
    },
)

EVIDENCE = [
    Item("evidence.elastic_casing.rings", {"table": table("casing_rings")}, sources=["config/scenes.yaml"]),
    Item(
        "evidence.elastic_casing.effect",
        {"table": table("casing_effect")},
        {"responses": CASINGS.responses(BLADES, *SCENES)},
        {"speeds": list(range(SPEEDS["start"], SPEEDS["stop"] + 1, SPEEDS["step"]))},
    ),
    Item(
        "evidence.pictures.of_run",
        {"picture": "docs/casing_Ref.png"},
        {"figure": f"{CASINGS.folder}/figures/casing_{'__'.join(DRAWN)}.png"},
    ),
]
