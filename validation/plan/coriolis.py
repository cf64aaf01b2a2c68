"""What the Coriolis force changes (docs/coriolis.md)."""

from evidence.plan import Item, Run, table

BLADES = ("Ref", "S50", "S100", "CS100")

CORIOLIS = Run("coriolis", keys={"structure": {"coriolis": True}})

EVIDENCE = [
    Item(
        "evidence.coriolis.peaks",
        {"table": table("coriolis_peaks")},
        {"models": [f"{CORIOLIS.folder}/{blade}/rom_pressure_edge.nc" for blade in BLADES]},
    )
]
