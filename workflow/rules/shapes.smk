# Shapes to look at: modes, and the worst instant of each interaction, for scenes with `shapes` among their results.
from r37core.shapes import PARTS as SHAPE_PARTS
from r37core.shapes.plan import MODE_SHAPES, WORST_SHAPES, Shapes

shown_shapes = Shapes(sweep)


rule mode_shapes:
    input:
        mesh=rules.mesh.output.vtu,
        model=structure.whole_blade_model,
    output:
        directory(MODE_SHAPES),
    log:
        "<logs>/shapes/{blade}_modes.log",
    conda:
        ENVIRONMENT
    params:
        modes=shown_shapes.modes,
        code=code("mode_shapes"),
    script:
        "../scripts/mode_shapes.py"


rule worst_shapes:
    input:
        mesh=rules.mesh.output.vtu,
        model=structure.whole_blade_model,
        campbell=rules.campbell_of_blade.output[0],
        response=rules.response.output[0],
        speeds=sweep.speed_files,
    output:
        directory(WORST_SHAPES),
    log:
        "<logs>/shapes/{blade}_{scene}.log",
    conda:
        ENVIRONMENT
    params:
        speeds=sweep.speeds,
        interactions=plain(settings.interactions),
        material=structure.elastic,
        code=code("worst_shapes"),
    script:
        "../scripts/worst_shapes.py"


rule shapes_page:
    input:
        rules.mode_shapes.output,
        shown_shapes.worst_shapes,
    output:
        report(
            "<results>/shapes/{blade}.html",
            **shown(PACKAGE / "shapes/report.rst", "{blade}", EVERY_SCENE, figure="moving shapes"),
        ),
    log:
        "<logs>/shapes/{blade}_page.log",
    conda:
        ENVIRONMENT
    params:
        scenes=shown_shapes.scenes,
        parts=parts_hash(SHAPE_PARTS),
        code=code("shapes_page"),
    script:
        "../scripts/shapes_page.py"


rule modes_figure:
    input:
        rules.mode_shapes.output,
    output:
        **pictures("shapes_{blade}", "{blade}", EVERY_SCENE, "first modes"),
    log:
        "<logs>/figures/shapes_{blade}.log",
    conda:
        ENVIRONMENT
    params:
        caption=captioned("mode_shapes"),
        code=code("shapes_figure"),
    script:
        "../scripts/shapes_figure.py"


use rule modes_figure as worst_shapes_figure with:
    input:
        rules.worst_shapes.output,
    output:
        **pictures("shapes_{blade}__{scene}", "{blade}", "{scene}", "worst instants"),
    log:
        "<logs>/figures/shapes_{blade}__{scene}.log",
    params:
        caption=captioned("worst_shapes"),
