# Shapes to look at: modes, and the worst instant of each interaction, for scenes with `shapes` among their results.
from r37core.shapes import PARTS as SHAPE_PARTS


rule mode_shapes:
    input:
        mesh=paths.MESH,
        model=exported.model,
    output:
        directory(paths.MODE_SHAPES),
    log:
        "<logs>/shapes/{blade}_modes.log",
    conda:
        ENVIRONMENT
    params:
        modes=settings.config.shapes.modes,
        code=code("mode_shapes"),
    script:
        "../scripts/mode_shapes.py"


rule worst_shapes:
    input:
        mesh=paths.MESH,
        model=exported.model,
        campbell=paths.CAMPBELL,
        response=paths.RESPONSE,
        speeds=sweep.speed_files,
    output:
        directory(paths.WORST_SHAPES),
    log:
        "<logs>/shapes/{blade}_{scene}.log",
    conda:
        ENVIRONMENT
    params:
        speeds=sweep.speeds,
        interactions=plain(settings.interactions),
        stress_instants=settings.fidelity.time_integration.stress_instants,
        material=structure.elastic,
        code=code("worst_shapes"),
    script:
        "../scripts/worst_shapes.py"


rule shapes_page:
    input:
        shapes.folders,
    output:
        paths.SHAPES_PAGE,
    log:
        "<logs>/shapes/{blade}_page.log",
    conda:
        ENVIRONMENT
    params:
        scenes=shapes.scenes,
        parts=parts_hash(SHAPE_PARTS),
        code=code("shapes_page"),
    script:
        "../scripts/shapes_page.py"


rule modes_figure:
    input:
        paths.MODE_SHAPES,
    output:
        report(
            paths.MODES_FIGURE,
            **shown(TEXTS / "figure.rst", "{blade}", EVERY_SCENE, figure="first modes"),
        ),
    log:
        "<logs>/figures/shapes_{blade}.log",
    conda:
        ENVIRONMENT
    params:
        caption=captioned("mode_shapes"),
        code=code("shapes_figure"),
    script:
        "../scripts/shapes_figure.py"


rule worst_shapes_figure:
    input:
        paths.WORST_SHAPES,
    output:
        report(
            paths.WORST_FIGURE,
            **shown(TEXTS / "figure.rst", "{blade}", "{scene}", figure="worst instants"),
        ),
    log:
        "<logs>/figures/shapes_{blade}__{scene}.log",
    conda:
        ENVIRONMENT
    params:
        caption=captioned("worst_shapes"),
        code=code("shapes_figure"),
    script:
        "../scripts/shapes_figure.py"
