# Results for other programs: mesh, surface, modes, worst stress, matrices. Not part of all_blades: snakemake exports
from r37core.plans.export_plan import Exports

exported = Exports(imported, sweep)


use rule step as exported_mesh with:
    input:
        mesh=rules.mesh.output.vtu,
    output:
        mesh=paths.EXPORTED_MESH,
    log:
        "<logs>/exports/{blade}_mesh_{format}.log",
    wildcard_constraints:
        format="msh|vtu|med|bdf|inp",
    params:
        **step("exchange.exporting.steps.mesh"),
        blade="{blade}",
        material=structure.elastic,
        orientation=exported.orientation,


use rule step as exported_surface with:
    input:
        geometry=rules.geometry.output.geometry,
    output:
        surface=paths.EXPORTED_SURFACE,
    log:
        "<logs>/exports/{blade}_surface.log",
    params:
        **step("exchange.exporting.steps.surface"),


use rule reduced_model as whole_blade_model with:
    output:
        rom=temp(paths.WHOLE_BLADE_MODEL),
    log:
        "<logs>/exports/{blade}_model_{tip_line}.log",
    priority: 0
    params:
        reduction=exported.reduction,


use rule step as exported_modes with:
    input:
        mesh=rules.mesh.output.vtu,
        model=exported.model,
    output:
        folder=directory(paths.EXPORTED_MODES),
    log:
        "<logs>/exports/{blade}_modes.log",
    params:
        **step("exchange.exporting.steps.modes"),
        choice=exported.choice,
        orientation=exported.orientation,


use rule step as exported_stress with:
    input:
        mesh=rules.mesh.output.vtu,
        model=exported.model,
        speeds=exported.speed_files,
    output:
        folder=directory(paths.EXPORTED_STRESS),
    log:
        "<logs>/exports/{blade}_stress_{scene}.log",
    params:
        **step("exchange.exporting.steps.stress"),
        choice=exported.choice,
        speeds=sweep.speeds,
        only_worst=exported.only_worst,
        material=structure.elastic,
        orientation=exported.orientation,


use rule step as exported_matrices with:
    input:
        unpack(exported.matrix_files),
    output:
        folder=directory(paths.EXPORTED_MATRICES),
    log:
        "<logs>/exports/{blade}_matrices.log",
    params:
        **step("exchange.exporting.steps.matrices"),
        choice=exported.choice,
        tip_line=settings.structure.boundary.tip_line,
        material=structure.material,


rule exports:
    input:
        paths.filled(exported.targets),
