# Families of designs (docs/blades.md).
module families:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "families",
            blades_file="validation/families.yaml",
            blades=["Sweep", "Lean"],
            scenes=["material_abradable", "direct"],
            fidelity="draft",
        )


use rule * from families as families_*


use rule evidence as blades_families with:
    input:
        unpack(behind_engine(designs="results/runs/families/designs.csv")),
    output:
        table=f"{TABLES}/families.csv",
    log:
        "logs/validation/blades_families.log",
    params:
        **evidence("designs.families"),


use rule evidence as blades_correlations with:
    input:
        unpack(behind_engine(designs="results/runs/families/designs.csv")),
    output:
        table=f"{TABLES}/families_correlations.csv",
    log:
        "logs/validation/blades_correlations.log",
    params:
        **evidence("designs.correlations"),
