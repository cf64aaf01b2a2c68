"""Rotors against single blades about 1B/4 (docs/rotor.md)."""

from evidence.plan import Item, Run, table
from evidence.rotor import KINDS, SINGLE

from plan.runs import DECIDING

# a second shape with the usual mistuning alone
SCENES = {"Ref": [SINGLE, *KINDS], "CS50": [SINGLE, "mistuned_1"]}

ROTORS = Run(
    "rotors",
    keys={
        **DECIDING,
        "scenes_file": "validation/decisions.yaml",
        "scenes": [SINGLE, *KINDS],
        "blades": list(SCENES),
        "fidelity": "draft",
        "speeds": [{"start": 1668, "stop": 1778, "step": 10}],
        "speeds_for": [{"blades": ["CS50"], "speeds": [{"start": 1540, "stop": 1650, "step": 10}]}],
    },
)

EVIDENCE = [
    Item(
        "evidence.rotor.kinds",
        {"table": table("rotor_kinds")},
        {
            f"{blade}_{scene}": f"{ROTORS.folder}/{blade}/{scene}/{'response' if scene == SINGLE else 'rotor'}.nc"
            for blade, scenes in SCENES.items()
            for scene in scenes
        },
        {"scenes": SCENES},
    ),
    Item(
        "evidence.pictures.of_run",
        {"picture": "docs/rotor.png"},
        {"figure": f"{ROTORS.folder}/figures/rotor_Ref__mistuned_1.png"},
    ),
]
