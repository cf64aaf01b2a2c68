# Families of designs: how robust each is, beside what it is.
from r37core.designs.plan import Families
from r37core.designs.plan import families as families_of

families = Families(settings)


use rule step as design_table with:
    input:
        **{kind: datasets[kind] for kind in sweep.kinds if kind in ("rms", "stress", "fatigue")},
        campbell=rules.campbell_of_all.output[0],
        summary=rules.summary.output[0],
        geometry=expand(paths.nominal(paths.GEOMETRY), blade=families.designs),
    output:
        table=shown("<results>/designs.csv", PACKAGE / "designs/report.rst", "Families", "table of designs"),
    log:
        "<logs>/designs.log",
    params:
        **step("designs.steps.tabulate"),
        designs=families.designs,
        densities=families.densities,
        scenes=list(settings.scenes),


use rule figure as design_figure with:
    input:
        table=rules.design_table.output[0],
    output:
        **pictures("designs_{family}", "Families", EVERY_SCENE, "{family}"),
    log:
        "<logs>/figures/designs_{family}.log",
    wildcard_constraints:
        family="|".join(families_of(settings)) or "none",
    params:
        **drawing(code, "designs.figures.draw_designs", "designs", blades=families.blades, varied=families.varied),
