# Families of designs, of blades and of scenes: how robust each is, next to what it is.
from r37core.designs.plan import Families

families = Families(settings)


use rule step as design_table with:
    input:
        **{kind: datasets[kind] for kind in sweep.kinds if kind in ("rms", "stress", "fatigue")},
        campbell=rules.campbell_of_all.output[0],
        summary=rules.summary.output[0],
        geometry=expand(paths.nominal(paths.GEOMETRY), blade=families.densities),
    output:
        table=shown("<results>/designs.csv", PACKAGE / "designs/report.rst", "Families", "table of designs"),
    log:
        "<logs>/designs.log",
    params:
        **step("designs.steps.tabulate"),
        pairs=families.pairs,
        variables=families.variables,
        families=families.names,
        densities=families.densities,
        operating=operating,


use rule figure as design_figure with:
    input:
        table=rules.design_table.output[0],
    output:
        **pictures("designs_{family}", "Families", EVERY_SCENE, "{family}"),
    log:
        "<logs>/figures/designs_{family}.log",
    wildcard_constraints:
        family="|".join(families.figures) or "none",
    params:
        **drawing("designs.figures.draw_designs", "designs", compared=families.compared),


use rule figure as design_map with:
    input:
        **offered("verdict", sweep),
        table=rules.design_table.output[0],
    output:
        **pictures("map_{family}", "Families", EVERY_SCENE, "map of {family}"),
    log:
        "<logs>/figures/map_{family}.log",
    wildcard_constraints:
        family="|".join(families.maps) or "none",
    params:
        **drawing("designs.maps.draw_design_map", "map", compared=families.mapped),
