# Run-ups and run-downs: the speed changes while the blade rubs; each is a run of its own.
from r37core.run_ups.plan import DATASET, RATES, RUN_UP, SECTION, TABLE, RunUps

run_ups = RunUps(sweep)


use rule step as run_up with:
    input:
        unpack(run_ups.inputs),
    output:
        run_up=RUN_UP,
    log:
        "<logs>/{blade}/{scene}/run_up_{run_up}.log",
    wildcard_constraints:
        run_up="|".join(settings.section(SECTION)) or "none",
    params:
        **stage(run_ups.stage(made)),


use rule step as run_ups_dataset with:
    input:
        run_ups=paths.filled({RUN_UP: run_ups.files}),
    output:
        dataset=DATASET,
    log:
        "<logs>/run_ups_dataset.log",
    params:
        **step("run_ups.steps.join"),
        runs=run_ups.runs,
        fidelity=settings.fidelity_name,


use rule step as run_up_tables with:
    input:
        dataset=DATASET,
    output:
        runs=shown(TABLE, PACKAGE / "run_ups/report.rst", TOGETHER, "run-ups"),
        rates=RATES,
    log:
        "<logs>/run_up_tables.log",
    params:
        **step("run_ups.steps.tables"),
