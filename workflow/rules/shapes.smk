# Shapes to look at: modes, and the worst instant of each interaction, for scenes with `shapes` among their results.
from r37core.shapes import PARTS as SHAPE_PARTS
from r37core.shapes.plan import MODE_SHAPES, PAGE, SECTION as SHAPES, WORST_SHAPES, Shapes

shown_shapes = Shapes(sweep)


use rule step as mode_shapes with:
    input:
        mesh=paths.nominal(paths.MESH),
        model=structure.whole_blade_model,
    output:
        folder=directory(MODE_SHAPES),
    log:
        "<logs>/shapes/{blade}_modes.log",
    params:
        **step("shapes.steps.modes"),
        modes=settings.section(SHAPES).modes,
        material=structure.elastic,


use rule step as worst_shapes with:
    input:
        mesh=paths.nominal(paths.MESH),
        model=structure.whole_blade_model,
        campbell=paths.nominal(paths.CAMPBELL),
        response=paths.nominal(paths.RESPONSE),
        speeds=sweep.speed_files,
    output:
        folder=directory(WORST_SHAPES),
    log:
        "<logs>/shapes/{blade}_{scene}.log",
    params:
        **step("shapes.steps.worst"),
        scene="{scene}",
        speeds=sweep.speeds,
        interactions=plain(settings.config.interactions),
        material=structure.elastic,


use rule step as shapes_page with:
    input:
        modes=rules.mode_shapes.output.folder,
        worst=shown_shapes.worst_shapes,
    output:
        page=shown(PAGE, PACKAGE / "shapes/report.rst", "{blade}", "moving shapes"),
    log:
        "<logs>/shapes/{blade}_page.log",
    params:
        **step("shapes.steps.page"),
        blade="{blade}",
        scenes=shown_shapes.scenes,
        parts=parts_hash(SHAPE_PARTS),
