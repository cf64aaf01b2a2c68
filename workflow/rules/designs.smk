# Families of designs: how robust each is, beside what it is.
from r37core.plans.family_plan import Families

families = Families(settings)


rule designs:
    input:
        **{kind: datasets[kind] for kind in sweep.kinds if kind in ("rms", "stress")},
        campbell=rules.campbell_of_all.output[0],
        summary=rules.summary.output[0],
        geometry=expand(paths.nominal(paths.GEOMETRY), blade=families.designs),
    output:
        report(
            "<results>/designs.csv",
            **shown(TEXTS / "designs.rst", "Families", EVERY_SCENE, figure="table of designs"),
        ),
    log:
        "<logs>/designs.log",
    conda:
        ENVIRONMENT
    params:
        designs=families.designs,
        densities=families.densities,
        scenes=list(settings.scenes),
        code=code("designs"),
    script:
        "../scripts/designs.py"


use rule figure as design_figure with:
    input:
        table=rules.designs.output[0],
    output:
        **pictures("designs_{family}", "Families", EVERY_SCENE, "{family}"),
    log:
        "<logs>/figures/designs_{family}.log",
    wildcard_constraints:
        family="|".join(settings.families) or "none",
    params:
        **drawing(code, "design_plot.draw_designs", "designs", blades=families.blades, varied=families.varied),
