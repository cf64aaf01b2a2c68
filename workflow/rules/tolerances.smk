# Tolerances: members of a sample, each with other values of what is never known exactly, and a run of its own at every speed.
from r37core.tolerances.sample import MEMBER_NAME


wildcard_constraints:
    member=MEMBER_NAME,


# a member whose blade is another one has a model of its own
use rule geometry as member_geometry with:
    output:
        geometry=of_member(paths.GEOMETRY),
    log:
        "<logs>/tolerances/models/{blade}/{member}/geometry.log",
    params:
        definition=tolerances.definition,
        edges=settings.structure.edges,
        provenance=tolerances.about_model,


use rule mesh as member_mesh with:
    input:
        geometry=rules.member_geometry.output.geometry,
    output:
        msh=of_member(paths.MESH.replace(".vtu", ".msh")),
        vtu=of_member(paths.MESH),
    log:
        "<logs>/tolerances/models/{blade}/{member}/mesh.log",


use rule reduced_model as member_model with:
    input:
        mesh=tolerances.mesh,
    output:
        rom=of_member(paths.REDUCED_MODEL),
    log:
        "<logs>/tolerances/models/{blade}/{member}/reduced_model_{tip_line}.log",
    params:
        material=tolerances.elastic,
        reduction=structure.reduction,
        provenance=tolerances.about_model,


use rule contact_model as member_contact_model with:
    input:
        rom=rules.member_model.output.rom,
    output:
        contact=of_member(paths.CONTACT_MODEL),
    log:
        "<logs>/tolerances/models/{blade}/{member}/contact_model_{tip_line}.log",


use rule stress_operator as member_stress_operator with:
    input:
        rom=rules.member_model.output.rom,
    output:
        stress=of_member(paths.STRESS_OPERATOR),
    log:
        "<logs>/tolerances/models/{blade}/{member}/stress_operator_{tip_line}.log",
    params:
        material=tolerances.elastic,


use rule campbell_of_blade as member_campbell with:
    input:
        rom=expand(rules.member_model.output, tip_line=settings.structure.boundary.tip_line, allow_missing=True)[0],
    output:
        campbell=of_member(paths.CAMPBELL),
    log:
        "<logs>/tolerances/models/{blade}/{member}/campbell.log",


# one message before the first run of a member, not one from each of its runs; a rule of all members would run with every new one
rule prepare_member:
    input:
        prepared=rules.prepare_time_integration.output,
        models=tolerances.models,
    output:
        touch(paths.MEMBER_STAMP),
    log:
        "<logs>/tolerances/{blade}/{scene}/{member}/prepare_member.log",
    priority: 15
    conda:
        ENVIRONMENT
    resources:
        **needs.of("simulate"),
    params:
        **served,
        task=tolerances.preparation,
        about=tolerances.about_run,
        speed=settings.structure.maximum_speed_rad_s,
    shell:
        "{params.python:q} -S -E {params.start:q} {params.script:q} {params.speed:q} {output:q} {log:q} {params.task:q} {params.about:q} {input.models:q}"


use rule simulate as simulate_member with:
    input:
        prepared=rules.prepare_member.output,
        models=tolerances.models,
    output:
        paths.MEMBER_SPEED,
    log:
        "<logs>/tolerances/{blade}/{scene}/{member}/speed_{speed}.log",
    params:
        **served,
        task=tolerances.task,
        about=tolerances.about_run,


# adaptive speeds: all members are run at the same ones, where they are worth it on average
checkpoint refine_members:
    input:
        unpack(tolerances.round_inputs),
    output:
        round=paths.MEMBER_ROUND,
    log:
        "<logs>/tolerances/{blade}/{scene}/round_{round}.log",
    wildcard_constraints:
        round=r"\d+",
    priority: 4
    conda:
        ENVIRONMENT
    resources:
        **needs.of("response"),
    params:
        **step("adaptive.steps.refine"),
        plan=sweep.refined_plan,
        choice=tolerances.refinement_choice,
        yields=tolerances.yields_of_round,
    script:
        "../scripts/step.py"


use rule response as member_response with:
    input:
        speeds=tolerances.speed_files,
    output:
        response=paths.MEMBER_RESPONSE,
    log:
        "<logs>/tolerances/{blade}/{scene}/{member}/response.log",
    params:
        speeds=sweep.speeds,
        stress_history_speeds=(),
        yield_stress=tolerances.yield_stress,
        provenance=tolerances.about_run,


use rule step as tolerances_dataset with:
    input:
        responses=paths.filled({paths.MEMBER_RESPONSE: tolerances.files}),
        rounds=tolerances.first_rounds,
    output:
        dataset="<results>/tolerances.nc",
    log:
        "<logs>/tolerances_dataset.log",
    resources:
        **needs.of("tolerances_dataset"),
    params:
        **step("tolerances.steps.join"),
        members=tolerances.files,
        numbers=tolerances.numbers,
        values=tolerances.values,
        fidelity=settings.fidelity_name,


use rule step as tolerance_table with:
    input:
        **tolerances.nominal,
        responses=paths.filled({paths.MEMBER_RESPONSE: tolerances.files_of_sample}),
        campbells=tolerances.campbells_of_sample,
        rounds=tolerances.first_rounds,
    output:
        table=report(
            "<results>/tolerances.csv",
            **shown(TEXTS / "tolerances.rst", TOGETHER, EVERY_SCENE, figure="tolerances"),
        ),
    log:
        "<logs>/tolerance_table.log",
    params:
        **step("tolerances.steps.table"),
        members=tolerances.files_of_sample,
        choice=plain(settings.interactions),


use rule figure as tolerance_figure with:
    input:
        tolerances=rules.tolerances_dataset.output[0],
        nominal=paths.RESPONSE,
    output:
        **pictures("tolerances_{blade}__{scene}", "{blade}", "{scene}", "tolerances"),
    log:
        "<logs>/figures/tolerances_{blade}__{scene}.log",
    params:
        **drawing(code, "figures.tolerance_curves.draw_tolerances", "tolerances"),


# the members alone, with the nominal runs beside them
rule tolerances:
    input:
        paths.filled({name: wildcards for name, wildcards in targets(sweep).items() if "tolerances" in name}),
