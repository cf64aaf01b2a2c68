# Motions that a start from rest does not show: a job sweeps up or down with the state carried on.
from r37studies.second_motions import plan as motions_plan

motions = settings.section(motions_plan.SECTION)
motion_pairs = motions_plan.pairs_of(settings)
motion_files = motions_plan.motion_keys(motion_pairs)


use rule step as second_motion_sweep with:
    input:
        unpack(sweep.run_inputs),
        runs=lambda wildcards: motions_plan.finished_runs(sweep, wildcards),
    output:
        response=motions_plan.RESPONSE,
        levels=motions_plan.LEVELS,
    log:
        "<logs>/{blade}/{scene}/second_motions_{motion}.log",
    wildcard_constraints:
        motion="|".join(motions_plan.MOTIONS),
    params:
        **step("r37studies.second_motions.steps.carry"),
        scene=sweep.plain_scene,
        # of a run from rest: those of the pipeline
        choice=lambda wildcards: to_plain(settings.integration_choice(wildcards.blade, wildcards.scene)),
        # without any speed where there are none, as the rule is there all the same
        sweep=to_plain(motions.sweep()) if motions.asked else None,
        motion=lambda wildcards: wildcards.motion,
        results=lambda wildcards: motions_plan.results(sweep, wildcards),
        kept=settings.fidelity.time_integration.kept,
        yield_stress=sweep.yield_stress,
        strengths=sweep.strengths,
        provenance=sweep.provenance,


use rule step as second_motions_tables with:
    input:
        responses=paths.filled({motions_plan.RESPONSE: motion_files}),
        levels=paths.filled({motions_plan.LEVELS: motion_files}),
    output:
        motions=motions_plan.DATASET,
        ranges=shown(motions_plan.TABLE, SOURCE / "r37studies/second_motions/report.rst", TOGETHER, "second motions"),
    log:
        "<logs>/second_motions_tables.log",
    params:
        **step("r37studies.second_motions.steps.join"),
        pairs=motion_pairs,
        blades=list(settings.blades),
        scenes=list(settings.scenes),
        fidelity=settings.fidelity_name,
