# Results for other programs: mesh, surface, modes, worst stress, matrices. Not part of all_blades: snakemake exports
from r37studies.exports import plan as exports_plan

exported = exports_plan.Exports(sweep)


use rule step as exported_mesh with:
    input:
        mesh=paths.MESH,
    output:
        mesh=exports_plan.EXPORTED_MESH,
    log:
        "<logs>/exports/{blade}_mesh_{format}.log",
    wildcard_constraints:
        format="|".join(exports_plan.FORMATS),
    params:
        **step("r37studies.exports.steps.mesh"),
        blade="{blade}",
        material=sweep.elastic,
        orientation=exported.orientation,


use rule step as exported_surface with:
    input:
        geometry=paths.GEOMETRY,
    output:
        surface=exports_plan.EXPORTED_SURFACE,
    log:
        "<logs>/exports/{blade}_surface.log",
    params:
        **step("r37studies.exports.steps.surface"),


use rule step as exported_modes with:
    input:
        mesh=paths.MESH,
        model=sweep.whole_blade_model,
    output:
        folder=directory(exports_plan.EXPORTED_MODES),
    log:
        "<logs>/exports/{blade}_modes.log",
    params:
        **step("r37studies.exports.steps.modes"),
        choice=exported.choice,
        orientation=exported.orientation,


use rule step as exported_stress with:
    input:
        mesh=paths.MESH,
        model=sweep.whole_blade_model,
        speeds=sweep.speed_files,
    output:
        folder=directory(exports_plan.EXPORTED_STRESS),
    log:
        "<logs>/exports/{blade}_stress_{scene}.log",
    params:
        **step("r37studies.exports.steps.stress"),
        speeds=sweep.speeds,
        only_worst=settings.section(exports_plan.SECTION).stress_speeds == "worst",
        material=sweep.elastic,
        orientation=exported.orientation,


use rule step as exported_matrices with:
    input:
        rom=lambda wildcards: paths.REDUCED_MODEL.format(
            blade=wildcards.blade, tip_line=settings.structure.boundary.tip_line
        ),
    output:
        folder=directory(exports_plan.EXPORTED_MATRICES),
    log:
        "<logs>/exports/{blade}_matrices.log",
    params:
        **step("r37studies.exports.steps.matrices"),
        choice=exported.choice,
