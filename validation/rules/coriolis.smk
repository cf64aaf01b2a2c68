# What the Coriolis force changes (docs/coriolis.md).
module coriolis:
    snakefile:
        "../../Snakefile"
    config:
        run("coriolis", structure={"coriolis": True})


use rule * from coriolis as coriolis_*


CORIOLIS_MODELS = behind_engine(*[f"results/runs/coriolis/{blade}/rom_pressure_edge.nc" for blade in BLADES])


use rule evidence as coriolis_frequencies with:
    input:
        unpack(CORIOLIS_MODELS),
    output:
        table=f"{TABLES}/coriolis_frequencies.csv",
    log:
        "logs/validation/coriolis_frequencies.log",
    params:
        **evidence("coriolis.frequencies"),


use rule evidence as coriolis_peaks with:
    input:
        unpack(CORIOLIS_MODELS),
    output:
        table=f"{TABLES}/coriolis_peaks.csv",
    log:
        "logs/validation/coriolis_peaks.log",
    params:
        **evidence("coriolis.peaks"),


use rule evidence as coriolis_bare_casing with:
    input:
        unpack(CORIOLIS_MODELS),
    output:
        table=f"{TABLES}/coriolis_bare_casing.csv",
    log:
        "logs/validation/coriolis_bare_casing.log",
    params:
        **evidence("coriolis.bare_casing"),


use rule evidence as coriolis_cost with:
    input:
        unpack(CORIOLIS_MODELS),
    output:
        table=f"{TABLES}/coriolis_cost.csv",
    log:
        "logs/validation/coriolis_cost.log",
    # two runs at the same time would disturb each other's clock
    threads: workflow.cores
    params:
        **evidence("coriolis.cost"),
