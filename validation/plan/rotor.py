"""Rotors against single blades about 1B/4 (docs/rotor.md)."""

from evidence.plan import Item, Run, table
from evidence.rotor import BLADES, KINDS, SINGLE

from plan.runs import DECIDING

ROTORS = Run(
    "rotors",
    keys={
        **DECIDING,
        "scenes_file": "validation/decisions.yaml",
        "scenes": [SINGLE, *KINDS],
        "blades": list(BLADES),
        # slower blades of a mistuned rotor have their interactions at lower speeds
        "speeds": [{"start": 1598, "stop": 1738, "step": 5}],
        "speeds_for": [{"blades": ["CS100"], "speeds": [{"start": 1278, "stop": 1418, "step": 5}]}],
    },
)

EVIDENCE = [
    Item(
        "evidence.rotor.kinds",
        {"table": table("rotor_kinds"), "picture": "docs/rotor.png"},
        {
            SINGLE: ROTORS.responses(BLADES, SINGLE),
            **{kind: [f"{ROTORS.folder}/{blade}/{kind}/rotor.nc" for blade in BLADES] for kind in KINDS},
        },
    )
]
