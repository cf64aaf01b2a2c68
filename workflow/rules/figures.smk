# Figures, each with a rule that its declaration makes: its datasets, the function that draws it, and a caption.
from r37core.figures.declared import BLADES
from r37core.product.targets import FIGURES

for figure in FIGURES:
    category = figure.category or ("{blade}" if "{blade}" in figure.name else TOGETHER)
    subcategory = "{scene}" if "{scene}" in figure.name else EVERY_SCENE

    # a variant of `step` cannot be named by a variable
    rule:
        name:
            figure.rule
        input:
            **figure.inputs(sweep),
            **{name: file for each in figure.offered for name, file in offered(each, sweep).items()},
        output:
            **pictures(figure.name, category, subcategory, figure.label),
        log:
            f"<logs>/figures/{figure.name}.log",
        wildcard_constraints:
            **figure.constraints(sweep),
        conda:
            ENVIRONMENT
        resources:
            mem_mb=500,
        params:
            **drawing(figure, sweep),
        script:
            str(SCRIPTS / "step.py")


shaped = [name for name in sweep.drawn["blade"] if name in sweep.meshed_blades]


# rendered off screen into its file
use rule step as blade_shapes_figure with:
    input:
        meshes=expand(paths.MESH, blade=shaped),
    output:
        **pictures("blades", TOGETHER, EVERY_SCENE, "shapes"),
    log:
        "<logs>/figures/blades.log",
    params:
        **step("r37core.figures.steps.blade_shapes"),
        blades=shaped,
        caption=BLADES,


rule campbell:
    input:
        rules.campbell_of_all.output,
        expand(rules.mesh.output.msh, blade=sweep.meshed_blades),
        expand(rules.campbell_figure.output, blade=sweep.drawn["blade"]),
        rules.blade_shapes_figure.output if shaped else [],
