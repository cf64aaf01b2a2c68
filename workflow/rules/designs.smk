# Families of designs: how robust each is, beside what it is.
from r37core.plans.family_plan import Families

families = Families(settings)


rule designs:
    input:
        **({"stress": "<results>/stress.nc"} if "stress" in sweep.kinds else {}),
        campbell="<results>/campbell.nc",
        summary="<results>/summary.csv",
        geometry=families.geometries,
    output:
        report(
            paths.DESIGNS,
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


rule design_figure:
    input:
        paths.DESIGNS,
    output:
        png=report(
            paths.DESIGN_FIGURE,
            **shown(TEXTS / "figure.rst", "Families", EVERY_SCENE, figure="{family}"),
        ),
        pdf=paths.as_pdf(paths.DESIGN_FIGURE),
    log:
        "<logs>/figures/designs_{family}.log",
    wildcard_constraints:
        family="|".join(settings.families) or "none",
    conda:
        ENVIRONMENT
    params:
        blades=families.blades,
        varied=families.varied,
        caption=captioned("designs"),
        code=code("design_figure"),
    script:
        "../scripts/design_figure.py"
