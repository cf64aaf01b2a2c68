# How long interactions on the lining last, and the thickness that suffices (docs/results.md).


use rule evidence as lasting_runs with:
    input:
        unpack(behind_engine(**models_of("Ref"))),
    output:
        "results/evidence/lasting.csv",
    log:
        "logs/validation/lasting_runs.log",
    params:
        **evidence("lasting.runs"),


use rule evidence as lasting with:
    input:
        unpack(behind_engine(runs="results/evidence/lasting.csv")),
    output:
        table=f"{TABLES}/lasting.csv",
        picture="docs/lasting.png",
    log:
        "logs/validation/lasting.log",
    params:
        **evidence("lasting.lasting"),


use rule evidence as sufficient_thickness_runs with:
    input:
        unpack(behind_engine(contact="results/Ref/contact_pressure_edge.npz")),
    output:
        "results/evidence/sufficient_thickness.csv",
    log:
        "logs/validation/sufficient_thickness_runs.log",
    params:
        **evidence("lasting.thickness_runs"),


use rule evidence as sufficient_thickness with:
    input:
        unpack(behind_engine(runs="results/evidence/sufficient_thickness.csv")),
    output:
        table=f"{TABLES}/sufficient_thickness.csv",
    log:
        "logs/validation/sufficient_thickness.log",
    params:
        **evidence("lasting.sufficient_thickness"),
