# What most rules are made of: a function of r37core, which step(...) names, called by one script (docs/architecture.md).


# the pattern of the others, never run by itself
rule step:
    log:
        "<logs>/step.log",
    # no other than what runs Snakemake; `snakemake --lint` asks for it
    conda:
        ENVIRONMENT
    # MB; reduced models alone need more. Under a limit (--resources mem_mb=...) only as many jobs run as fit
    resources:
        mem_mb=500,
    # absolute: rules of other folders take it over, where a relative path would start
    script:
        str(SCRIPTS / "step.py")
