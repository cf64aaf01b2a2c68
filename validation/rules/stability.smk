# What happens at extremes of the configuration (docs/stability.md).
module extremes:
    snakefile:
        "../../Snakefile"
    config:
        run("extremes", blades=["Ref"])


use rule * from extremes as extremes_*


use rule evidence as stability_tables with:
    input:
        unpack(behind_engine(cases="results/runs/extremes/stability.csv")),
    output:
        table=f"{TABLES}/stability.csv",
        inaccurate=f"{TABLES}/stability_inaccurate.csv",
        cases=f"{TABLES}/stability_cases.csv",
    log:
        "logs/validation/stability_tables.log",
    params:
        **evidence("stability.tables"),
