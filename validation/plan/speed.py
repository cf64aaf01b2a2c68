"""What runs cost."""

from evidence.plan import Item, Run, table

from plan.runs import DECIDING

BENCHMARK = {"blades": ["Ref"], "fidelity": "draft", "speeds": [{"start": 750, "stop": 2000, "step": 20}]}
ONE = {**DECIDING, **BENCHMARK}
TO_DECIDE = Run("estimate_to_decide", keys={**ONE, "estimate": {"every": 10}}, alone=True)
LINEAR = Run("estimate_benchmark", keys={**BENCHMARK, "estimate": {"every": 10}}, alone=True)
RUNS = {"to decide from": TO_DECIDE, "benchmark": LINEAR}

FAN = "examples/fan"
STUDIES = {
    "sweep": ([], ONE),
    "verdict": ([f"{FAN}/assess.yaml"], {"scenes": ["Room_0p00034_0p002"]}),
    "calibration": ([f"{FAN}/calibrate.yaml"], {"calibrate": {"runs": 12, "first": 6}}),
    "members": (
        ["config/tolerances.yaml"],
        {"blades": ["Ref"], "fidelity": "draft", "speeds_for": [], "tolerances": {"members": 4}},
    ),
    "search": (
        ["config/search.yaml"],
        {"search": {"designs": 4, "first": 2, "batch": 2}, "speeds": [{"start": 750, "stop": 2000, "step": 40}]},
    ),
}
"""Name -> files and keys of the configuration."""

GROWTH = {"speeds": (50, 500, 5000), "blades": (7, 70, 700), "nodes": (5000, 20000, 80000), "modes": (10, 20, 40)}

EVIDENCE = [
    Item("evidence.speed.runs", {"table": table("cost")}, {name: f"{run.folder}/estimate.csv" for name, run in RUNS.items()}),
    Item("evidence.speed.studies", {"table": table("cost_of_studies")}, params={"studies": STUDIES}, alone=True),
    Item(
        "evidence.speed.growth",
        {"table": table("cost_growth")},
        params={**GROWTH, "configuration": ONE},
        alone=True,
        memory_mb=8000,
    ),
]
"""What is made: one file for each subject declares its runs of the product, and in EVIDENCE its items."""
