"""What the Coriolis force changes (docs/coriolis.md)."""

from evidence.plan import Item, Run, table

from plan.runs import BLADES

CORIOLIS = Run("coriolis", keys={"structure": {"coriolis": True}})
MODELS = {"models": [f"{CORIOLIS.folder}/{blade}/rom_pressure_edge.nc" for blade in BLADES]}

EVIDENCE = [
    Item("evidence.coriolis.frequencies", {"table": table("coriolis_frequencies")}, MODELS),
    Item("evidence.coriolis.peaks", {"table": table("coriolis_peaks")}, MODELS),
]
