# What happens at extremes of the configuration. Not part of all_blades: snakemake stability
from r37core.stability import plan as stability_plan


use rule step as stability_table with:
    input:
        cases=cases["stability"].files,
    output:
        table=stability_plan.TABLE,
    log:
        "<logs>/stability_table.log",
    params:
        **step("stability.steps.report"),
