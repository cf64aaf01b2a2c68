# Reduced model -> one simulation per blade, scene and speed -> all speeds of a blade and scene.


use rule step as contact_model with:
    input:
        rom=rules.reduced_model.output.rom,
    output:
        contact=paths.CONTACT_MODEL,
    log:
        "<logs>/{blade}/contact_model_{tip_line}.log",
    priority: 2
    params:
        **stage("r37core.rom.steps.contact_model"),


use rule step as stress_operator with:
    input:
        rom=rules.reduced_model.output.rom,
    output:
        stress=paths.STRESS_OPERATOR,
    log:
        "<logs>/{blade}/stress_operator_{tip_line}.log",
    priority: 2
    params:
        **stage("r37core.stress.steps.stress_operator"),


use rule step as prepare_time_integration with:
    input:
        models=sweep.models,
    output:
        touch(paths.INTEGRATION_STAMP),
    log:
        "<logs>/{blade}/{scene}/prepare_time_integration.log",
    # the sweep's jobs find the time integration compiled; one message before the sweep instead of one from each of its jobs. Nothing here
    # may depend on which speeds are run: more speeds would renew the stamp, and with it run all of them again
    priority: 15
    params:
        **step("r37core.time_integration.speed_job.prepare"),
        scene=sweep.plain_scene,
        speed=settings.structure.maximum_speed_rad_s,
        choice=sweep.choice_of_scene,


use rule step as simulate with:
    input:
        prepared=rules.prepare_time_integration.output,
        models=sweep.models,
    output:
        paths.SPEED,
    log:
        "<logs>/{blade}/{scene}/speed_{speed}.log",
    # results are to be complete one blade after another
    priority: lambda wildcards: 1 - list(settings.blades).index(wildcards.blade) / len(settings.blades)
    resources:
        mem_mb=300,
    params:
        **step("r37core.time_integration.speed_job.simulate"),
        # one parameter, as Snakemake takes a millisecond to ask for each
        job=lambda wildcards: {"speed": wildcards.speed, "task": sweep.task(wildcards)},
        about=sweep.provenance,


# a second, between the jobs of a cluster
localrules:
    refine,


# adaptive speed sampling: each round asks for some more, from what those before it gave, until one asks for none
checkpoint refine:
    input:
        unpack(sweep.round_inputs),
    output:
        round=paths.ROUND,
    log:
        "<logs>/{blade}/{scene}/round_{round}.log",
    wildcard_constraints:
        round=r"\d+",
    # before the next blade's simulations, which would leave this one's waiting
    priority: 4
    conda:
        ENVIRONMENT
    resources:
        mem_mb=500,
    params:
        **step("r37core.adaptive.steps.refine"),
        plan=lambda wildcards: to_plain(sweep.speed_plan(wildcards)),
        choice=sweep.refinement_choice,
        yield_stress=sweep.yield_stress,
    script:
        str(SCRIPTS / "step.py")


use rule step as response with:
    input:
        speeds=sweep.speed_files,
    output:
        response=paths.RESPONSE,
    log:
        "<logs>/{blade}/{scene}/response.log",
    priority: 5
    params:
        **step("r37core.results.steps.response"),
        speeds=sweep.speeds,
        stress_history_speeds=sweep.stress_history_speeds,
        yield_stress=sweep.yield_stress,
        strengths=sweep.strengths,
        provenance=sweep.provenance,
