# What a flexible casing changes (docs/elastic_casing.md). The models are those of the main job.
CASING_MODELS = behind_engine(*[f"results/{blade}/contact_pressure_edge.npz" for blade in BLADES])
CASING_CAMPBELL = behind_engine(campbell="results/campbell.nc")


module elastic_casing:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "elastic_casing",
            "elastic_casing",
            blades=["Ref"],
            scenes=["elastic_abradable"],
            speeds=[{"start": 1600, "stop": 1800, "step": 4}],
        )


use rule * from elastic_casing as elastic_casing_*


use rule evidence as casing_peaks with:
    input:
        unpack(CASING_MODELS),
    output:
        table=f"{TABLES}/casing_peaks.csv",
    log:
        "logs/validation/casing_peaks.log",
    params:
        **evidence("elastic_casing.peaks"),


use rule evidence as casing_bare with:
    input:
        unpack(CASING_MODELS),
    output:
        table=f"{TABLES}/casing_bare.csv",
    log:
        "logs/validation/casing_bare.log",
    params:
        **evidence("elastic_casing.bare_casing"),


use rule evidence as casing_diameters with:
    input:
        unpack(CASING_MODELS),
    output:
        table=f"{TABLES}/casing_diameters.csv",
    log:
        "logs/validation/casing_diameters.log",
    params:
        **evidence("elastic_casing.diameters"),


use rule evidence as casing_overtaken with:
    input:
        unpack(CASING_MODELS),
    output:
        table=f"{TABLES}/casing_overtaken.csv",
    log:
        "logs/validation/casing_overtaken.log",
    params:
        **evidence("casing_waves.overtaken"),


use rule evidence as casing_causes with:
    input:
        unpack(CASING_MODELS),
    output:
        table=f"{TABLES}/casing_causes.csv",
    log:
        "logs/validation/casing_causes.log",
    params:
        **evidence("casing_waves.causes"),


use rule evidence as casing_growth with:
    input:
        unpack(CASING_MODELS),
    output:
        table=f"{TABLES}/casing_growth.csv",
    log:
        "logs/validation/casing_growth.log",
    params:
        **evidence("casing_waves.growth"),


use rule evidence as casing_rings with:
    input:
        unpack(CASING_MODELS),
    output:
        table=f"{TABLES}/casing_rings.csv",
    log:
        "logs/validation/casing_rings.log",
    params:
        **evidence("casing_waves.rings"),


use rule evidence as casing_flexibility with:
    input:
        unpack(CASING_MODELS),
    output:
        table=f"{TABLES}/casing_flexibility.csv",
    log:
        "logs/validation/casing_flexibility.log",
    params:
        **evidence("casing_waves.flexibilities"),


use rule evidence as casing_cost with:
    input:
        unpack(CASING_MODELS),
    output:
        table=f"{TABLES}/casing_cost.csv",
    log:
        "logs/validation/casing_cost.log",
    # two runs at the same time would disturb each other's clock
    threads: workflow.cores
    params:
        **evidence("elastic_casing.cost"),


use rule evidence as casing_coincidences with:
    input:
        unpack(CASING_CAMPBELL),
    output:
        table=f"{TABLES}/casing_coincidences.csv",
    log:
        "logs/validation/casing_coincidences.log",
    params:
        **evidence("casing_waves.coincidences"),
