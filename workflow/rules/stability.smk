# What happens at extremes of the configuration. Not part of all_blades: snakemake stability
from r37core.stability import plan as stability_plan

stability_cases = Cases(settings, "stability", stability_plan.cases)


use rule case as stability_case with:
    input:
        unpack(stability_cases.inputs),
    output:
        response=stability_cases.file,
    log:
        stability_cases.log,
    params:
        case=stability_cases.case,


use rule step as stability_table with:
    input:
        cases=stability_cases.files,
    output:
        table=stability_plan.TABLE,
    log:
        "<logs>/stability_table.log",
    params:
        **step("stability.steps.report"),
