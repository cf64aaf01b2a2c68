# What an engineer decides: clearance and lining (docs/clearance_and_lining.md), fatigue below yield (docs/requirements.md).
DECIDED = ["Ref", "S100", "CS50"]
LARGE = {
    "structure": {"kinematics": "quadratic", "boundary": {"contact": "patches"}},
    "speeds": [{"start": 1080, "stop": 1860, "step": 20}],
    "operating": {"idle_rpm": 10400, "redline_rpm": 17700},
}


module decide:
    snakefile:
        "../../Snakefile"
    config:
        run("decide", "decide", structure=LINEAR, blades=DECIDED)


use rule * from decide as decide_*


# the same at clearances 0.01 mm apart, with one lining
module decide_fine:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "decide_fine",
            "decide",
            structure=LINEAR,
            blades=DECIDED,
            scenes=["Fine"],
            scenes_file="validation/decisions.yaml",
        )


use rule * from decide_fine as decide_fine_*


# with large displacements the runs of the sweep alone: no blade fails clearly, so a verdict tries hundreds of runs of each
module decide_large:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "decide_large",
            blades=DECIDED,
            scenes=["Room"],
            scenes_file="config/decide_scenes.yaml",
            **LARGE,
        )


use rule * from decide_large as decide_large_*


# a verdict on three of them
module decide_rubbing:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "decide_rubbing",
            blades=["S100"],
            scenes=["Rubbing"],
            scenes_file="validation/decisions.yaml",
            **LARGE,
            requirements={"above_yield_at_most_rad_s": 0},
        )


use rule * from decide_rubbing as decide_rubbing_*


module fatigue_below_yield:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "fatigue_below_yield",
            blades_file="validation/strengths.yaml",
            blades=["Ref"],
            scenes=["Low"],
            scenes_file="validation/decisions.yaml",
            speeds=[{"start": 1000, "stop": 1800, "step": 10}],
        )


use rule * from fatigue_below_yield as fatigue_below_yield_*


use rule evidence as clearance_and_lining with:
    input:
        unpack(
            behind_engine(
                coarse=["results/runs/decide/designs.csv", "results/runs/decide/verdict.csv"],
                fine=["results/runs/decide_fine/designs.csv", "results/runs/decide_fine/verdict.csv"],
            )
        ),
    output:
        table=f"{TABLES}/clearance_and_lining.csv",
    log:
        "logs/validation/clearance_and_lining.log",
    params:
        **evidence("decisions.limits"),


use rule evidence as clearance_and_lining_large with:
    input:
        unpack(behind_engine(designs="results/runs/decide_large/designs.csv")),
    output:
        table=f"{TABLES}/clearance_and_lining_large.csv",
        picture="docs/clearance_and_lining.png",
    log:
        "logs/validation/clearance_and_lining_large.log",
    params:
        **evidence("decisions.lengths"),


use rule evidence as clearance_and_lining_verdict with:
    input:
        unpack(behind_engine(verdict="results/runs/decide_rubbing/verdict.csv")),
    output:
        table=f"{TABLES}/clearance_and_lining_verdict.csv",
    log:
        "logs/validation/clearance_and_lining_verdict.log",
    params:
        **evidence("decisions.verdicts"),


use rule evidence as fatigue_below_yield with:
    input:
        unpack(
            behind_engine(
                stress="results/runs/fatigue_below_yield/stress.nc",
                ranking="results/runs/fatigue_below_yield/ranking.csv",
                picture="results/runs/fatigue_below_yield/figures/fatigue_Ref__Low.png",
            )
        ),
    output:
        table=f"{TABLES}/fatigue_below_yield.csv",
        picture="docs/fatigue.png",
    log:
        "logs/validation/fatigue_below_yield.log",
    params:
        **evidence("decisions.fatigue"),
