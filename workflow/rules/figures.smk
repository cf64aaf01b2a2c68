# Pictures of the results, as variants of one rule: each has its datasets, the function of r37core.figures that draws it, and a
# caption. Pictures that are rendered off screen have a step of their own.


# the pattern of the others, never run by itself
use rule step as figure with:
    log:
        "<logs>/figures/figure.log",


use rule figure as campbell_figure with:
    input:
        campbell=paths.nominal(paths.CAMPBELL),
    output:
        **pictures("campbell_{blade}", "{blade}", EVERY_SCENE, "Campbell diagram"),
    log:
        "<logs>/figures/campbell_{blade}.log",
    params:
        **drawing("figures.campbell_diagram.draw_campbell", "campbell", casings=joined.casings),


use rule figure as campbell_overview with:
    input:
        campbell=rules.campbell_of_all.output[0],
    output:
        **pictures("campbell", TOGETHER, EVERY_SCENE, "Campbell diagrams"),
    log:
        "<logs>/figures/campbell_overview.log",
    params:
        **drawing("figures.campbell_diagram.draw_campbell_overview", "campbell_overview", drawn=sweep.drawn),


use rule figure as response_figure with:
    input:
        unpack(joined.response_pictured),
        **more_motions,
    output:
        **pictures("response_{blade}", "{blade}", EVERY_SCENE, "response"),
    log:
        "<logs>/figures/response_{blade}.log",
    params:
        **drawing("figures.response_curves.draw_response", "response", drawn=sweep.drawn),


use rule figure as response_overview with:
    input:
        rms=expand(rules.sweep_dataset.output, kind="rms")[0],
    output:
        **pictures("response", TOGETHER, EVERY_SCENE, "responses"),
    log:
        "<logs>/figures/response_overview.log",
    params:
        **drawing("figures.response_curves.draw_response_overview", "response_overview", drawn=sweep.drawn),


use rule figure as map_figure with:
    input:
        campbell=rules.campbell_of_all.output[0],
        maps=rules.sweep_dataset.output[0],
    output:
        **pictures("{kind}_{blade}__{scene}", "{blade}", "{scene}", "{kind}"),
    log:
        "<logs>/figures/{kind}_{blade}__{scene}.log",
    wildcard_constraints:
        kind="|".join(MAPS),
    params:
        **drawing("figures.maps.draw_map"),


use rule figure as waterfall_figure with:
    input:
        campbell=rules.campbell_of_all.output[0],
        maps=expand(rules.sweep_dataset.output, kind="spectrum")[0],
    output:
        **pictures("waterfall_{blade}__{scene}", "{blade}", "{scene}", "waterfall"),
    log:
        "<logs>/figures/waterfall_{blade}__{scene}.log",
    params:
        **drawing("figures.waterfall.draw_waterfall", "waterfall"),


use rule figure as comparison_figure with:
    input:
        unpack(joined.compared),
    output:
        **pictures("comparison_{scene}", TOGETHER, "{scene}", "around an interaction"),
    log:
        "<logs>/figures/comparison_{scene}.log",
    params:
        **drawing(
            "figures.comparison.draw_comparison",
            "comparison",
            below=settings.config.interactions.below,
            above=settings.config.interactions.above,
            drawn=sweep.drawn,
        ),


use rule figure as ranking_figure with:
    input:
        ranking=rules.ranking.output[0],
    output:
        **pictures("ranking", TOGETHER, EVERY_SCENE, "ranking"),
    log:
        "<logs>/figures/ranking.log",
    params:
        **drawing("figures.comparison.draw_ranking", "ranking", scenes=sweep.drawn["scene"]),


use rule figure as clearance_figure with:
    input:
        rms=expand(rules.sweep_dataset.output, kind="rms")[0],
    output:
        **pictures("clearance_{scene}", TOGETHER, "{scene}", "clearance"),
    log:
        "<logs>/figures/clearance_{scene}.log",
    params:
        **drawing("figures.response_curves.draw_clearance", "clearance", drawn=sweep.drawn),


use rule step as fatigue_figure with:
    input:
        mesh=paths.nominal(paths.MESH),
        rom=sweep.reduced_model,
        response=paths.nominal(paths.RESPONSE),
    output:
        **pictures("fatigue_{blade}__{scene}", "{blade}", "{scene}", "fatigue"),
    log:
        "<logs>/figures/fatigue_{blade}__{scene}.log",
    params:
        **step("figures.steps.fatigue"),
        title="{blade}, {scene}",
        caption=captioned("fatigue"),


shaped = [name for name in sweep.drawn["blade"] if name in imported.meshed_blades]


use rule step as blade_shapes_figure with:
    input:
        meshes=expand(paths.nominal(paths.MESH), blade=shaped),
    output:
        **pictures("blades", TOGETHER, EVERY_SCENE, "shapes"),
    log:
        "<logs>/figures/blades.log",
    params:
        **step("figures.steps.blade_shapes"),
        blades=shaped,
        caption=captioned("blades"),


rule campbell:
    input:
        rules.campbell_of_all.output,
        expand([paths.nominal(rules.mesh.output.msh), *rules.abaqus_deck.output], blade=imported.meshed_blades),
        expand(rules.campbell_figure.output, blade=sweep.drawn["blade"]),
        rules.campbell_overview.output,
        rules.blade_shapes_figure.output if shaped else [],
