# Modes, and the worst instant of each interaction, of scenes with `shapes` among their results.
from r37studies.shapes.plan import MODE_SHAPES, SECTION as SHAPES, WORST_SHAPES


use rule step as mode_shapes with:
    input:
        mesh=paths.MESH,
        model=sweep.whole_blade_model,
    output:
        folder=directory(MODE_SHAPES),
    log:
        "<logs>/shapes/{blade}_modes.log",
    params:
        **step("r37studies.shapes.steps.modes"),
        modes=settings.section(SHAPES).modes,
        material=sweep.elastic,


use rule step as worst_shapes with:
    input:
        mesh=paths.MESH,
        model=sweep.whole_blade_model,
        campbell=paths.CAMPBELL,
        response=paths.RESPONSE,
        speeds=sweep.speed_files,
    output:
        folder=directory(WORST_SHAPES),
    log:
        "<logs>/shapes/{blade}_{scene}.log",
    params:
        **step("r37studies.shapes.steps.worst"),
        scene="{scene}",
        speeds=sweep.speeds,
        interactions=plain(settings.config.interactions),
        material=sweep.elastic,
