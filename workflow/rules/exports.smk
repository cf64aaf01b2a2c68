# Results for other programs: mesh, surface, modes, worst stress, matrices. Not part of all_blades: snakemake exports
from r37core.exports.plan import (
    EXPORTED_MATRICES,
    EXPORTED_MESH,
    EXPORTED_MODES,
    EXPORTED_STRESS,
    EXPORTED_SURFACE,
    Exports,
)

exported = Exports(imported, sweep)


rule exported_mesh:
    input:
        rules.mesh.output.vtu,
    output:
        EXPORTED_MESH,
    log:
        "<logs>/exports/{blade}_mesh_{format}.log",
    wildcard_constraints:
        format="msh|vtu|med|bdf|inp",
    conda:
        ENVIRONMENT
    params:
        material=structure.elastic,
        orientation=exported.orientation,
        code=code("exported_mesh"),
    script:
        "../scripts/exported_mesh.py"


rule exported_surface:
    input:
        rules.geometry.output,
    output:
        EXPORTED_SURFACE,
    log:
        "<logs>/exports/{blade}_surface.log",
    conda:
        ENVIRONMENT
    params:
        code=code("exported_surface"),
    script:
        "../scripts/exported_surface.py"


rule exported_modes:
    input:
        mesh=rules.mesh.output.vtu,
        model=structure.whole_blade_model,
    output:
        directory(EXPORTED_MODES),
    log:
        "<logs>/exports/{blade}_modes.log",
    conda:
        ENVIRONMENT
    params:
        choice=exported.choice,
        orientation=exported.orientation,
        code=code("exported_modes"),
    script:
        "../scripts/exported_modes.py"


rule exported_stress:
    input:
        mesh=rules.mesh.output.vtu,
        model=structure.whole_blade_model,
        speeds=exported.speed_files,
    output:
        directory(EXPORTED_STRESS),
    log:
        "<logs>/exports/{blade}_stress_{scene}.log",
    conda:
        ENVIRONMENT
    params:
        choice=exported.choice,
        speeds=sweep.speeds,
        only_worst=exported.only_worst,
        material=structure.elastic,
        orientation=exported.orientation,
        code=code("exported_stress"),
    script:
        "../scripts/exported_stress.py"


rule exported_matrices:
    input:
        unpack(exported.matrix_files),
    output:
        directory(EXPORTED_MATRICES),
    log:
        "<logs>/exports/{blade}_matrices.log",
    conda:
        ENVIRONMENT
    params:
        choice=exported.choice,
        tip_line=settings.structure.boundary.tip_line,
        material=structure.material,
        code=code("exported_matrices"),
    script:
        "../scripts/exported_matrices.py"
