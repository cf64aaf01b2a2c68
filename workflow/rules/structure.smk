# Blade shape -> mesh -> reduced model -> Campbell diagram, for each blade. A blade of another program comes in as
# a mesh (imported_mesh) or as matrices (imported_matrices) and takes the same way from there.


rule geometry:
    output:
        paths.GEOMETRY,
    log:
        "<logs>/{blade}/geometry.log",
    wildcard_constraints:
        blade=imported.profiles,
    # an impossible shape should stop the run before any long work
    priority: 10
    conda:
        ENVIRONMENT
    resources:
        **needs.of("geometry"),
    params:
        definition=structure.definition,
        edges=settings.structure.edges,
        provenance=made.shape,
        code=code("geometry"),
    script:
        "../scripts/geometry.py"


rule mesh:
    input:
        rules.geometry.output,
    output:
        msh="<results>/{blade}/mesh.msh",
        vtu=paths.MESH,
    log:
        "<logs>/{blade}/mesh.log",
    wildcard_constraints:
        blade=imported.profiles,
    # a mesh or model that fails should do so before the first simulation
    priority: 2
    conda:
        ENVIRONMENT
    resources:
        **needs.of("mesh"),
    params:
        mesh=plain(settings.fidelity.mesh),
        code=code("mesh"),
    script:
        "../scripts/mesh.py"


rule imported_mesh:
    input:
        imported.files,
    output:
        **rules.mesh.output,
    log:
        "<logs>/{blade}/mesh.log",
    wildcard_constraints:
        blade=imported.meshes,
    # as of geometry: an unsuitable mesh should stop the run before any long work
    priority: 10
    conda:
        ENVIRONMENT
    resources:
        **needs.of("mesh"),
    params:
        source=imported.source,
        folder=imported.folder,
        places=imported.places,
        code=code("imported_mesh"),
    script:
        "../scripts/imported_mesh.py"


rule abaqus_deck:
    input:
        rules.mesh.output.vtu,
    output:
        "<results>/{blade}/mesh.inp",
    log:
        "<logs>/{blade}/abaqus_deck.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("abaqus_deck"),
    params:
        material=structure.elastic,
        code=code("abaqus_deck"),
    script:
        "../scripts/abaqus_deck.py"


rule reduced_model:
    input:
        rules.mesh.output.vtu,
    output:
        paths.REDUCED_MODEL,
    log:
        "<logs>/{blade}/reduced_model_{tip_line}.log",
    wildcard_constraints:
        blade=f"{imported.profiles}|{imported.meshes}",
    priority: 2
    conda:
        ENVIRONMENT
    resources:
        **needs.of("reduced_model"),
    params:
        material=structure.elastic,
        reduction=structure.reduction,
        contact=structure.place_of_contact,
        made_before=structure.made_before,
        provenance=made.structure,
        code=code("reduced_model"),
    script:
        "../scripts/reduced_model.py"


# recovered on every node, for who asks for shapes, gauges or files for other programs
use rule reduced_model as whole_blade_model with:
    output:
        temp(paths.WHOLE_BLADE_MODEL),
    log:
        "<logs>/{blade}/whole_blade_model_{tip_line}.log",
    priority: 0
    params:
        reduction=structure.whole_blade_reduction,


rule imported_matrices:
    input:
        imported.files,
    output:
        rules.reduced_model.output,
    log:
        "<logs>/{blade}/reduced_model_{tip_line}.log",
    wildcard_constraints:
        blade=imported.matrices,
    priority: 10
    conda:
        ENVIRONMENT
    resources:
        **needs.of("reduced_model"),
    params:
        source=imported.source,
        folder=imported.folder,
        places=imported.places,
        reduction=structure.reduction,
        contact=structure.place_of_contact,
        provenance=made.structure,
        code=code("imported_matrices"),
    script:
        "../scripts/imported_matrices.py"


rule campbell_of_blade:
    input:
        expand(rules.reduced_model.output, tip_line=settings.structure.boundary.tip_line, allow_missing=True),
    output:
        paths.CAMPBELL,
    log:
        "<logs>/{blade}/campbell.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("campbell_of_blade"),
    params:
        campbell=si_fields(settings.campbell),
        maximum_speed=settings.structure.maximum_speed_rad_s,
        tip_line=settings.structure.boundary.tip_line,
        provenance=made.structure,
        code=code("campbell_of_blade"),
    script:
        "../scripts/campbell_of_blade.py"


rule campbell_of_all:
    input:
        expand(rules.campbell_of_blade.output, blade=settings.blades),
    output:
        "<results>/campbell.nc",
    log:
        "<logs>/campbell_of_all.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("campbell_of_all"),
    params:
        blades=list(settings.blades),
        fidelity=settings.fidelity_name,
        code=code("campbell_of_all"),
    script:
        "../scripts/campbell_of_all.py"
