# Blade shape -> mesh -> reduced model -> Campbell diagram, for each blade.
# memory of a reduced model (MB): half more than was measured
memory_of_model = 200 + round(0.075 * settings.fidelity.mesh.nodes)


use rule step as geometry with:
    output:
        geometry=paths.GEOMETRY,
    log:
        "<logs>/{blade}/geometry.log",
    wildcard_constraints:
        blade=sweep.pattern("geometry"),
    # an impossible shape should stop the run before any long work
    priority: 10
    params:
        **stage("r37core.blade.steps.geometry"),


use rule step as mesh with:
    input:
        geometry=rules.geometry.output.geometry,
    output:
        msh="<results>/{blade}/mesh.msh",
        vtu=paths.MESH,
    log:
        "<logs>/{blade}/mesh.log",
    wildcard_constraints:
        blade=sweep.pattern("mesh"),
    # a mesh or model that fails should do so before the first simulation
    priority: 2
    params:
        **stage("r37core.fem.steps.mesh"),


use rule step as reduced_model with:
    input:
        mesh=paths.MESH,
    output:
        rom=paths.REDUCED_MODEL,
    log:
        "<logs>/{blade}/reduced_model_{tip_line}.log",
    wildcard_constraints:
        blade=sweep.pattern("reduced_model"),
    priority: 2
    resources:
        mem_mb=memory_of_model,
    params:
        **stage("r37core.rom.steps.reduced_model"),


# recovered on every node, for who asks for shapes, gauges or files for other programs
use rule reduced_model as whole_blade_model with:
    output:
        rom=temp(paths.WHOLE_BLADE_MODEL),
    log:
        "<logs>/{blade}/whole_blade_model_{tip_line}.log",
    priority: 0
    params:
        reduction=lambda wildcards: {**sweep.reduction(wildcards), "recover_whole_blade": True},
        kept=False,


use rule step as campbell_of_blade with:
    input:
        rom=expand(rules.reduced_model.output, tip_line=settings.structure.boundary.tip_line, allow_missing=True)[0],
    output:
        campbell=paths.CAMPBELL,
    log:
        "<logs>/{blade}/campbell.log",
    params:
        **stage("r37core.results.steps.campbell_of_blade"),


use rule step as campbell_of_all with:
    input:
        campbells=expand(paths.CAMPBELL, blade=settings.blades),
    output:
        campbell="<results>/campbell.nc",
    log:
        "<logs>/campbell_of_all.log",
    params:
        **step("r37core.results.steps.campbell_of_all"),
        blades=list(settings.blades),
        fidelity=settings.fidelity_name,
