# What lies in the folder of the results and what made it, for archives and journals.


use rule step as crate with:
    input:
        files=[
            *rules.campbell_of_all.output,
            *rules.configuration.output,
            *rules.summary.output,
            *(table for table in tables(sweep) if table.count("/") == 1),
        ],
    output:
        crate="<results>/ro-crate-metadata.json",
    log:
        "<logs>/crate.log",
    params:
        **step("results.steps.describe"),
