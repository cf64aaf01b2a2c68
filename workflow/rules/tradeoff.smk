# The price of every approximation, one parameter at a time. Not part of all_blades: snakemake tradeoff
from r37core.tradeoff import plan as tradeoff_plan

tradeoff_cases = Cases(settings, "tradeoff", tradeoff_plan.cases)


use rule case as tradeoff_case with:
    input:
        unpack(tradeoff_cases.inputs),
    output:
        response=tradeoff_cases.file,
    log:
        tradeoff_cases.log,
    params:
        case=tradeoff_cases.case,


use rule step as tradeoff_tables with:
    input:
        cases=tradeoff_cases.files,
    output:
        dataset="<results>/tradeoff.nc",
        table="<results>/tradeoff.csv",
        levels="<results>/tradeoff_levels.csv",
        growth="<results>/tradeoff_growth.csv",
    log:
        "<logs>/tradeoff_tables.log",
    params:
        **step("tradeoff.steps.report"),
        values=lambda wildcards: tradeoff_plan.values(settings),


use rule figure as tradeoff_figure with:
    input:
        table=rules.tradeoff_tables.output.table,
    output:
        **pictures("tradeoff", TOGETHER, EVERY_SCENE, "accuracy and cost"),
    log:
        "<logs>/figures/tradeoff.log",
    params:
        **drawing("tradeoff.figures.draw_tradeoff", "tradeoff"),


use rule figure as tradeoff_growth_figure with:
    input:
        table=rules.tradeoff_tables.output.table,
        growth=rules.tradeoff_tables.output.growth,
    output:
        **pictures("tradeoff_growth", TOGETHER, EVERY_SCENE, "growth of costs"),
    log:
        "<logs>/figures/tradeoff_growth.log",
    params:
        **drawing("tradeoff.figures.draw_growth", "tradeoff_growth"),


use rule figure as tradeoff_parameter_figure with:
    input:
        table=rules.tradeoff_tables.output.table,
    output:
        **pictures("tradeoff_{parameter}", TOGETHER, EVERY_SCENE, "{parameter}"),
    log:
        "<logs>/figures/tradeoff_{parameter}.log",
    wildcard_constraints:
        parameter="|".join(tradeoff_plan.CHANGES),
    params:
        **drawing("tradeoff.figures.draw_parameter", "tradeoff_parameter", parameter="{parameter}"),
