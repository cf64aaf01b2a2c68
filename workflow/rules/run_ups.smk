# Run-ups and run-downs: the speed changes while the blade rubs; each is a run of its own.
from r37core.run_ups.plan import RUN_UP, RunUps, entries

run_ups = RunUps(sweep)


use rule step as run_up with:
    input:
        unpack(run_ups.inputs),
    output:
        run_up=RUN_UP,
    log:
        "<logs>/{blade}/{scene}/run_up_{run_up}.log",
    wildcard_constraints:
        run_up="|".join(entries(settings)) or "none",
    params:
        **stage(run_ups.stage(made)),


use rule step as run_ups_dataset with:
    input:
        run_ups=paths.filled({RUN_UP: run_ups.files}),
    output:
        dataset="<results>/run_ups.nc",
    log:
        "<logs>/run_ups_dataset.log",
    params:
        **step("run_ups.steps.join"),
        runs=run_ups.runs,
        fidelity=settings.fidelity_name,


use rule step as run_up_tables with:
    input:
        dataset=rules.run_ups_dataset.output.dataset,
    output:
        runs=shown("<results>/run_ups.csv", PACKAGE / "run_ups/report.rst", TOGETHER, "run-ups"),
        rates="<results>/run_up_rates.csv",
    log:
        "<logs>/run_up_tables.log",
    params:
        **step("run_ups.steps.tables"),


use rule figure as run_up_figure with:
    input:
        run_ups=rules.run_ups_dataset.output[0],
    output:
        **pictures("run_ups_{blade}__{scene}", "{blade}", "{scene}", "run-ups"),
    log:
        "<logs>/figures/run_ups_{blade}__{scene}.log",
    params:
        **drawing("run_ups.figures.draw_run_ups", "run_ups", blade="{blade}", scene="{scene}"),


use rule figure as run_up_rates_figure with:
    input:
        runs=rules.run_up_tables.output.runs,
    output:
        **pictures("run_up_rates_{scene}", TOGETHER, "{scene}", "rates"),
    log:
        "<logs>/figures/run_up_rates_{scene}.log",
    params:
        **drawing("run_ups.figures.draw_rates", "run_up_rates", scene="{scene}"),
