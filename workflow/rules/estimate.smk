# What a whole sweep will cost, from a sample of its runs. Not part of all_blades: snakemake estimate
from r37core.estimate import plan as estimate_plan

estimate_cases = Cases(settings, "estimate", estimate_plan.cases)


use rule case as estimate_case with:
    input:
        unpack(estimate_cases.inputs),
    output:
        response=estimate_cases.file,
    log:
        estimate_cases.log,
    params:
        case=estimate_cases.case,


use rule step as estimate_table with:
    input:
        cases=estimate_cases.files,
    output:
        table=estimate_plan.TABLE,
    log:
        "<logs>/estimate_table.log",
    params:
        **step("estimate.steps.report"),
        values=lambda wildcards: estimate_plan.values(settings, samples),
