# The price of every approximation, one parameter at a time. Not part of all_blades: snakemake tradeoff
from r37core.tradeoff import plan as tradeoff_plan


use rule step as tradeoff_tables with:
    input:
        cases=cases["tradeoff"].files,
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
