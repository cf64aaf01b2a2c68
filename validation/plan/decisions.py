"""What an engineer decides: clearance and lining (docs/clearance_and_lining.md), fatigue (docs/requirements.md)."""

from evidence.plan import Item, Run, table

from plan.runs import DECIDING

# about 1B/4 of each, where the blades are above yield on a lining
ROOM = Run(
    "decide",
    ("decide",),
    {
        "blades": ["Ref", "S100", "CS50"],
        "fidelity": "draft",
        "speeds": [{"start": 1640, "stop": 1800, "step": 10}],
        "speeds_for": [
            {"blades": ["S100"], "speeds": [{"start": 1610, "stop": 1770, "step": 10}]},
            {"blades": ["CS50"], "speeds": [{"start": 1510, "stop": 1670, "step": 10}]},
        ],
    },
)

RUBBING = Run(
    "decide_rubbing",
    keys={
        **DECIDING,
        "scenes_file": "validation/decisions.yaml",
        "scenes": ["Rubbing_0p0004", "Rubbing_0p00075"],
        "blades": ["Ref"],
        "fidelity": "draft",
        "speeds": [{"start": 1680, "stop": 1760, "step": 10}],
        "operating": {"idle_rad_s": 1680, "redline_rad_s": 1760},
        "requirements": {"above_yield_at_most_rad_s": 0},
    },
)

FATIGUE = Run(
    "fatigue",
    keys={
        **DECIDING,
        "scenes_file": "validation/decisions.yaml",
        "scenes": ["low"],
        "blades_file": "validation/strengths.yaml",
        "blades": ["Ref"],
        "fidelity": "draft",
        "speeds": [{"start": 1000, "stop": 1800, "step": 20}],
    },
)

EVIDENCE = [
    Item(
        "evidence.decisions.lengths",
        {"table": table("clearance_and_lining"), "picture": "docs/clearance_and_lining.png"},
        {"designs": f"{ROOM.folder}/designs.csv"},
    ),
    Item(
        "evidence.decisions.verdicts",
        {"table": table("clearance_and_lining_verdict")},
        {"verdict": f"{RUBBING.folder}/verdict.csv"},
    ),
    Item(
        "evidence.decisions.fatigue",
        {"table": table("goodman")},
        {"stress": f"{FATIGUE.folder}/stress.nc", "ranking": f"{FATIGUE.folder}/ranking.csv"},
    ),
    Item(
        "evidence.pictures.of_run",
        {"picture": "docs/fatigue.png"},
        {"figure": f"{FATIGUE.folder}/figures/fatigue_Ref__low.png"},
    ),
]
