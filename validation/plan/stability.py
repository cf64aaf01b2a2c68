"""What happens at extremes of the configuration (docs/stability.md)."""

from evidence.plan import Item, Run, table

# what a user changes first; extremes of mesh and model take a reduced model each
TRIED = [
    "exact_modal_step_over_limit",
    "speed_over_crossing",
    "clearance",
    "damping_ratio",
    "friction",
    "elastic_modulus",
    "bars",
]
STABILITY = Run("extremes", keys={"blades": ["Ref"], "stability": {"extremes": TRIED}})

EVIDENCE = [Item("evidence.stability.counts", {"table": table("stability")}, {"cases": f"{STABILITY.folder}/stability.csv"})]
