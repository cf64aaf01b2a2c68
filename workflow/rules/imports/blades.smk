# A blade of another program comes in as a mesh or as matrices, and goes through the same rules from there.


use rule step as imported_mesh with:
    input:
        sweep.files,
    output:
        msh=rules.mesh.output.msh,
        vtu=paths.MESH,
    log:
        "<logs>/{blade}/mesh.log",
    wildcard_constraints:
        blade=sweep.pattern("imported_mesh"),
    # an unsuitable mesh, like an impossible shape, should stop the run before any long work
    priority: 10
    params:
        **stage("r37imports.importing.steps.imported_mesh"),


use rule step as imported_matrices with:
    input:
        sweep.files,
    output:
        rom=paths.REDUCED_MODEL,
    log:
        "<logs>/{blade}/reduced_model_{tip_line}.log",
    wildcard_constraints:
        blade=sweep.pattern("imported_matrices"),
    priority: 10
    resources:
        mem_mb=memory_of_model,
    params:
        **stage("r37imports.importing.steps.imported_matrices"),
