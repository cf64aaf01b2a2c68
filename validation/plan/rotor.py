"""Rotors against single blades about 1B/4 (docs/rotor.md)."""

from evidence.plan import Item, Run, table
from evidence.rotor import BLADES, KINDS

from plan.runs import ALL_SPEEDS, DECIDING


def _about(first: int, begin: int, end: int, last: int) -> list[dict[str, int]]:
    """Speeds from `first` to `last` (rad/s) every 10 rad/s, and every 5 from `begin` to `end`."""
    ends = ((first, begin - 10, 10), (begin, end, 5), (end + 10, last, 10))
    return [{"start": start, "stop": stop, "step": step} for start, stop, step in ends]


ALONE, FINER = ["single", "single_twice"], ["mistuned_1"]

ROTORS = Run(
    "rotors",
    keys={
        **DECIDING,
        "scenes_file": "validation/decisions.yaml",
        "scenes": list(KINDS),
        "blades": list(BLADES),
        # from 8% below 1B/4 to 6% above it: all that the page advises to avoid
        "speeds": [{"start": 1538, "stop": 1778, "step": 10}],
        "speeds_for": [
            {"scenes": ALONE, "blades": ["CS100"], "speeds": [{"start": 1253, "stop": 1448, "step": 2.5}]},
            {"scenes": ALONE, "speeds": [{"start": 1538, "stop": 1778, "step": 2.5}]},
            {"scenes": FINER, "blades": ["CS100"], "speeds": _about(1258, 1278, 1418, 1448)},
            {"scenes": FINER, "speeds": _about(1538, 1598, 1738, 1778)},
            {"blades": ["CS100"], "speeds": [{"start": 1258, "stop": 1448, "step": 10}]},
        ],
    },
    priority=3,
)

EVIDENCE = [
    Item(
        "evidence.rotor.kinds",
        {"table": table("rotor_kinds"), "picture": "docs/rotor.png"},
        {
            **{kind: ROTORS.responses(BLADES, kind) for kind in KINDS},
            "rotors": f"{ROTORS.folder}/rotors.csv",
            "campbell": f"{ALL_SPEEDS.folder}/campbell.nc",
        },
    )
]
