"""Run-ups through an interaction (docs/run_ups.md)."""

from typing import Any

from evidence.plan import Item, Run, table

from plan.runs import DECIDING

LINED = "material_abradable"
AS_SHIPPED = {**DECIDING, "scenes": [LINED], "speeds": [1000]}
RUN_UPS = Run("run_ups", ("run_ups",), AS_SHIPPED)

VARIED, RATE = ["Ref", "CS100"], 3000


def _run_up(first: float = -0.015, last: float = 0.07, **keys: Any) -> dict[str, Any]:
    """A run-up between speeds relative to the crossing of 1B with engine order 4."""
    crossing = {"mode": "1B", "engine_order": 4, "first": first, "last": last}
    return {"crossing": crossing, "rate_rad_s2": RATE, "revolutions_after": 50, "blades": VARIED, **keys}


VARIANTS = {
    "begun 0.5% below the crossing": _run_up(first=-0.005),
    "ended 15% above the crossing": _run_up(last=0.15),
    "twice the revolutions before": _run_up(revolutions_before=800),
    "lining worn by the same run-up": _run_up(lining="worn"),
}
NAMES = {name: f"variant_{number}" for number, name in enumerate(VARIANTS)}
RUN_UPS_VARIED = Run(
    "run_ups_varied", keys={**AS_SHIPPED, "run_ups": {NAMES[name]: run_up for name, run_up in VARIANTS.items()}}
)
RUN_UPS_DRAFT = Run("run_ups_draft", keys={**AS_SHIPPED, "fidelity": "draft", "run_ups": {"draft": _run_up()}})

EVIDENCE = [
    Item("evidence.run_ups.rates", {"table": table("run_ups")}, {"run_ups": f"{RUN_UPS.folder}/run_ups.csv"}),
    Item(
        "evidence.run_ups.variants",
        {"table": table("run_up_variants")},
        {"run_ups": [f"{run.folder}/run_ups.csv" for run in (RUN_UPS, RUN_UPS_VARIED, RUN_UPS_DRAFT)]},
        {"blades": VARIED, "names": {"as above": f"up_{RATE}", "level `draft`": "draft", **NAMES}},
    ),
    Item(
        "evidence.pictures.of_run",
        {"picture": "docs/run_up_rates.png"},
        {"figure": f"{RUN_UPS.folder}/figures/run_up_rates_{LINED}.png"},
    ),
]
