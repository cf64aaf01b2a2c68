# What a run costs (docs/speed.md).
EVERY_SPEED = [{"start": 750, "stop": 2000, "step": 1}]


module estimate_standard:
    snakefile:
        "../../Snakefile"
    config:
        run("estimate_standard", speeds=EVERY_SPEED, estimate={"every": 200})


use rule * from estimate_standard as estimate_standard_*


module estimate_paper:
    snakefile:
        "../../Snakefile"
    config:
        run("estimate_paper", fidelity="paper", speeds=EVERY_SPEED, estimate={"every": 200})


use rule * from estimate_paper as estimate_paper_*


use rule evidence as speed_campaign with:
    input:
        unpack(behind_engine(*[f"results/runs/estimate_{level}/estimate.csv" for level in ("standard", "paper")])),
    output:
        table=f"{TABLES}/speed_campaign.csv",
    log:
        "logs/validation/speed_campaign.log",
    params:
        **evidence("speed.campaign"),


use rule evidence as speed_steps with:
    input:
        unpack(behind_engine(model="results/Ref/contact_pressure_edge.npz")),
    output:
        table=f"{TABLES}/speed_steps.csv",
    log:
        "logs/validation/speed_steps.log",
    params:
        **evidence("speed.steps"),


use rule evidence as speed_growth with:
    input:
        unpack(behind_engine(*accuracy_runs)),
    output:
        table=f"{TABLES}/speed_growth.csv",
    log:
        "logs/validation/speed_growth.log",
    params:
        **evidence("speed.growth"),
