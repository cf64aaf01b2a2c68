"""A clearance that changes with the speed (docs/clearance.md), and how long interactions last (docs/results.md)."""

from evidence.plan import Item, Run, table

from plan.runs import DECIDING

BLADES = ("Ref", "L100", "S100")
FIXED, GROWING = "lined", "growing"
LENGTHS = {"after_200": "200", "after_1000": "1,000", "settled": "until settled"}

VARIANTS = Run(
    "clearance",
    keys={
        **DECIDING,
        "scenes_file": "validation/decisions.yaml",
        "scenes": [FIXED, GROWING, *LENGTHS],
        "blades": list(BLADES),
        "fidelity": "draft",
        "speeds": [{"start": 1650, "stop": 1770, "step": 6}],
        "speeds_for": [
            {"blades": ["S100"], "speeds": [{"start": 1610, "stop": 1730, "step": 6}]},
            {"blades": ["L100"], "speeds": [{"start": 1550, "stop": 1670, "step": 6}]},
        ],
    },
)

EVIDENCE = [
    Item(
        "evidence.clearance.tip",
        {"table": table("clearance_tip")},
        {
            "campbell": f"{VARIANTS.folder}/campbell.nc",
            "contacts": [f"{VARIANTS.folder}/{blade}/contact_pressure_edge.npz" for blade in BLADES],
            "models": [f"{VARIANTS.folder}/{blade}/rom_pressure_edge.nc" for blade in BLADES],
            "meshes": [f"{VARIANTS.folder}/{blade}/mesh.vtu" for blade in BLADES],
        },
        {"blades": BLADES},
        program="ccx",
    ),
    Item(
        "evidence.clearance.effect",
        {"table": table("clearance_effect")},
        {"fixed": VARIANTS.responses(BLADES, FIXED), "growing": VARIANTS.responses(BLADES, GROWING)},
        {"blades": BLADES},
    ),
    Item(
        "evidence.lasting.lasting",
        {"table": table("lasting"), "picture": "docs/lasting.png"},
        {"runs": VARIANTS.responses(["Ref"], *LENGTHS)},
        {"revolutions": list(LENGTHS.values())},
    ),
]
