# Families of designs, of blades and of scenes: how robust each is, next to what it is.
from r37studies.designs import plan as designs_plan

families = settings.made(designs_plan.Families)


use rule step as design_table with:
    input:
        **{kind: datasets[kind] for kind in sweep.kinds if kind in ("rms", "stress", "fatigue")},
        **further_runs,
        campbell=rules.campbell_of_all.output[0],
        summary=rules.summary.output[0],
        geometry=expand(paths.GEOMETRY, blade=families.densities),
    output:
        table=shown(designs_plan.TABLE, SOURCE / "r37studies/designs/report.rst", "Families", "table of designs"),
    log:
        "<logs>/designs.log",
    params:
        **step("r37studies.designs.steps.tabulate"),
        pairs=families.pairs,
        errors=level_errors(settings, families.pairs),
        variables=families.variables,
        families={"blade": settings.designs.family_of, "scene": settings.scene_designs.family_of},
        densities=families.densities,
        operating=operating,
