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
        table="<results>/stability.csv",
    log:
        "<logs>/stability_table.log",
    params:
        **step("stability.steps.report"),


use rule figure as stability_figure with:
    input:
        table=rules.stability_table.output.table,
    output:
        **pictures("stability", TOGETHER, EVERY_SCENE, "extremes"),
    log:
        "<logs>/figures/stability.log",
    params:
        **drawing("stability.figures.draw_stability", "stability"),
