"""Rotors against single blades about 1B/4 (docs/rotor.md)."""

from evidence.plan import Item, Run, table
from evidence.rotor import KINDS, SINGLE

from plan.runs import DECIDING

ROTORS = Run(
    "rotors",
    keys={
        **DECIDING,
        "scenes_file": "validation/decisions.yaml",
        "scenes": [SINGLE, *KINDS],
        "blades": ["Ref"],
        "fidelity": "draft",
        "speeds": [{"start": 1668, "stop": 1778, "step": 10}],
        # slower blades have their interactions at lower speeds
        "speeds_for": [
            {
                "blades": ["Ref"],
                "scenes": ["mistuned_1", "mistuned_1_other"],
                "speeds": [{"start": 1618, "stop": 1778, "step": 10}],
            }
        ],
    },
)

EVIDENCE = [
    Item(
        "evidence.rotor.kinds",
        {"table": table("rotor_kinds")},
        {
            SINGLE: f"{ROTORS.folder}/Ref/{SINGLE}/response.nc",
            **{kind: f"{ROTORS.folder}/Ref/{kind}/rotor.nc" for kind in KINDS},
        },
    ),
    Item(
        "evidence.pictures.of_run",
        {"picture": "docs/rotor.png"},
        {"figure": f"{ROTORS.folder}/figures/rotor_Ref__mistuned_1.png"},
    ),
]
