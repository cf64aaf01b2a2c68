# Motions that a start from rest does not show: sweeps up and down with the state carried on, dwells, branches of periodic motions.
from r37core.second_motions.plan import (
    ALL_DWELLS,
    ALL_ORBITS,
    BIFURCATIONS,
    DATASET,
    DWELL_TABLE,
    DWELLS,
    ORBITS,
    TABLE,
)
from r37core.second_motions.plan import RESPONSE, STATES, SecondMotions

second_motions = SecondMotions(sweep)


use rule step as second_motion_sweep with:
    input:
        unpack(second_motions.models),
    output:
        response=RESPONSE,
        states=STATES,
    log:
        "<logs>/{blade}/{scene}/second_motions_{motion}.log",
    wildcard_constraints:
        motion="up|down|rest",
    params:
        **stage(second_motions.sweep_stage(made)),


use rule step as second_motion_dwells with:
    input:
        unpack(second_motions.swept_files),
    output:
        dwells=DWELLS,
    log:
        "<logs>/{blade}/{scene}/second_motions_dwells.log",
    params:
        **stage(second_motions.dwell_stage(made)),


use rule step as second_motion_branches with:
    input:
        unpack(second_motions.swept_files),
    output:
        orbits=ORBITS,
    log:
        "<logs>/{blade}/{scene}/second_motions_orbits.log",
    params:
        **stage(second_motions.branch_stage(made)),


use rule step as second_motions_dataset with:
    input:
        responses=paths.filled({RESPONSE: second_motions.runs}),
        states=paths.filled({STATES: second_motions.runs}),
    output:
        dataset=DATASET,
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
        parts=paths.filled({DWELLS: paths.run_keys(second_motions.pairs)}),
    output:
        dataset=ALL_DWELLS,
    log:
        "<logs>/second_motions_all_dwells.log",
    params:
        **step("second_motions.steps.join_parts"),
        pairs=second_motions.pairs,
        along="dwell",
        fidelity=settings.fidelity_name,


use rule step as second_motions_all_orbits with:
    input:
        parts=paths.filled({ORBITS: paths.run_keys(second_motions.bare)}),
    output:
        dataset=ALL_ORBITS,
    log:
        "<logs>/second_motions_all_orbits.log",
    params:
        **step("second_motions.steps.join_parts"),
        pairs=second_motions.bare,
        along="orbit",
        fidelity=settings.fidelity_name,


use rule step as second_motions_tables with:
    input:
        dataset=DATASET,
        dwells=ALL_DWELLS,
    output:
        ranges=shown(TABLE, PACKAGE / "second_motions/report.rst", TOGETHER, "second motions"),
        dwells=DWELL_TABLE,
    log:
        "<logs>/second_motions_tables.log",
    params:
        **step("second_motions.steps.tabulate"),


use rule step as second_motions_bifurcations with:
    input:
        orbits=ALL_ORBITS,
    output:
        table=BIFURCATIONS,
    log:
        "<logs>/second_motions_bifurcations.log",
    params:
        **step("second_motions.steps.tabulate_branches"),
