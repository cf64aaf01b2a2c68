# Run-ups and run-downs: the speed changes while the blade rubs; each is a run of its own.
from r37studies.run_ups import plan as run_ups_plan

run_ups = run_ups_plan.RunUps(sweep)
stages |= {"run_up": run_ups.stage()}


use rule step as run_up with:
    input:
        unpack(run_ups.inputs),
    output:
        run_up=run_ups_plan.RUN_UP,
    log:
        "<logs>/{blade}/{scene}/run_up_{run_up}.log",
    wildcard_constraints:
        run_up="|".join(settings.section(run_ups_plan.SECTION)) or "none",
    params:
        **stage("r37studies.run_ups.steps.record"),


use rule step as run_ups_dataset with:
    input:
        run_ups=paths.filled({run_ups_plan.RUN_UP: run_ups.files}),
    output:
        dataset=run_ups_plan.DATASET,
    log:
        "<logs>/run_ups_dataset.log",
    params:
        **step("r37studies.run_ups.steps.join"),
        runs=run_ups.runs,
        fidelity=settings.fidelity_name,


use rule step as run_up_tables with:
    input:
        dataset=run_ups_plan.DATASET,
    output:
        runs=shown(run_ups_plan.TABLE, SOURCE / "r37studies/run_ups/report.rst", TOGETHER, "run-ups"),
        rates=run_ups_plan.RATES,
    log:
        "<logs>/run_up_tables.log",
    params:
        **step("r37studies.run_ups.steps.tables"),
