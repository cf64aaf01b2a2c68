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
        dataset=tradeoff_plan.DATASET,
        table=tradeoff_plan.TABLE,
        levels=tradeoff_plan.LEVELS,
        growth=tradeoff_plan.GROWTH,
    log:
        "<logs>/tradeoff_tables.log",
    params:
        **step("tradeoff.steps.report"),
        values=lambda wildcards: tradeoff_plan.values(settings),
