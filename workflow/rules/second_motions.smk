# Motions that a start from rest does not show: sweeps up and down with the state carried on, and dwells.
from r37core.second_motions import plan as motions_plan

second_motions = motions_plan.SecondMotions(sweep)
stages |= second_motions.stages(made)


use rule step as second_motion_sweep with:
    input:
        unpack(sweep.run_inputs),
    output:
        response=motions_plan.RESPONSE,
        states=motions_plan.STATES,
    log:
        "<logs>/{blade}/{scene}/second_motions_{motion}.log",
    wildcard_constraints:
        motion="up|down|rest",
    params:
        **stage(stages["second_motion_sweep"]),


use rule step as second_motion_dwells with:
    input:
        unpack(second_motions.swept_files),
    output:
        dwells=motions_plan.DWELLS,
    log:
        "<logs>/{blade}/{scene}/second_motions_dwells.log",
    params:
        **stage(stages["second_motion_dwells"]),


use rule step as second_motions_dataset with:
    input:
        responses=paths.filled({motions_plan.RESPONSE: second_motions.runs}),
        states=paths.filled({motions_plan.STATES: second_motions.runs}),
    output:
        dataset=motions_plan.DATASET,
    log:
        "<logs>/second_motions_dataset.log",
    params:
        **step("second_motions.steps.join"),
        runs=second_motions.runs,
        blades=list(settings.blades),
        scenes=list(settings.scenes),
        fidelity=settings.fidelity_name,


use rule step as second_motions_all_dwells with:
    input:
        parts=paths.filled({motions_plan.DWELLS: paths.run_keys(second_motions.pairs)}),
    output:
        dataset=motions_plan.ALL_DWELLS,
    log:
        "<logs>/second_motions_all_dwells.log",
    params:
        **step("second_motions.steps.join_parts"),
        pairs=second_motions.pairs,
        along="dwell",
        fidelity=settings.fidelity_name,


use rule step as second_motions_tables with:
    input:
        dataset=motions_plan.DATASET,
        dwells=motions_plan.ALL_DWELLS,
    output:
        ranges=shown(motions_plan.TABLE, PACKAGE / "second_motions/report.rst", TOGETHER, "second motions"),
        dwells=motions_plan.DWELL_TABLE,
    log:
        "<logs>/second_motions_tables.log",
    params:
        **step("second_motions.steps.tabulate"),
