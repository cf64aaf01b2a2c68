# Run-ups through an interaction (docs/run_ups.md).
module run_ups:
    snakefile:
        "../../Snakefile"
    config:
        run("run_ups", "run_ups", speeds=[1000])


use rule * from run_ups as run_ups_*


RUN_UPS = "results/runs/run_ups"


use rule evidence as run_up_rates with:
    input:
        unpack(
            behind_engine(
                campbell="results/campbell.nc",
                summary="results/summary.csv",
                run_ups=f"{RUN_UPS}/run_ups.csv",
                rates=f"{RUN_UPS}/run_up_rates.csv",
            )
        ),
    output:
        table=f"{TABLES}/run_up_rates.csv",
    log:
        "logs/validation/run_up_rates.log",
    params:
        **evidence("run_ups.rates"),


use rule evidence as run_up_segments with:
    input:
        unpack(behind_engine(campbell="results/campbell.nc", contact="results/Ref/contact_pressure_edge.npz")),
    output:
        table=f"{TABLES}/run_up_segments.csv",
    log:
        "logs/validation/run_up_segments.log",
    params:
        **evidence("run_ups.segments"),


use rule evidence as run_up_variants with:
    input:
        unpack(
            behind_engine(
                campbell="results/campbell.nc",
                contacts=[f"results/{blade}/contact_pressure_edge.npz" for blade in ("Ref", "S100", "CS50")],
                models=[f"results/{blade}/rom_pressure_edge.nc" for blade in ("Ref", "S100", "CS50")],
            )
        ),
    output:
        table=f"{TABLES}/run_up_variants.csv",
    log:
        "logs/validation/run_up_variants.log",
    params:
        **evidence("run_ups.variants"),


use rule evidence as run_up_cost with:
    input:
        unpack(behind_engine(contact="results/Ref/contact_pressure_edge.npz")),
    output:
        table=f"{TABLES}/run_up_cost.csv",
    log:
        "logs/validation/run_up_cost.log",
    # two runs at the same time would disturb each other's clock
    threads: workflow.cores
    params:
        **evidence("run_ups.cost"),
