# What a whole sweep will cost, from a sample of its runs. Not part of all_blades: snakemake estimate
from r37core.estimate import plan as estimate_plan
from r37core.product.extensions import simulations_of_members


use rule step as estimate_table with:
    input:
        cases=cases["estimate"].files,
    output:
        table=estimate_plan.TABLE,
    log:
        "<logs>/estimate_table.log",
    params:
        **step("estimate.steps.report"),
        values=lambda wildcards: estimate_plan.values(settings, simulations_of_members(settings)),
