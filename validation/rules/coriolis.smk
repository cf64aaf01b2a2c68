# What the Coriolis force changes (docs/coriolis.md).
module coriolis:
    snakefile:
        "../../Snakefile"
    config:
        run("coriolis", structure={"coriolis": True})


use rule * from coriolis as coriolis_*


use rule evidence as coriolis_frequencies with:
    input:
        unpack(behind_engine(*[f"results/runs/coriolis/{blade}/rom_pressure_edge.nc" for blade in BLADES])),
    output:
        table=f"{TABLES}/coriolis_frequencies.csv",
    log:
        "logs/validation/coriolis_frequencies.log",
    params:
        **evidence("coriolis.frequencies"),
