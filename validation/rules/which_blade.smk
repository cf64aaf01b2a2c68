# Which blade is the best, and how sure that is (docs/which_blade.md).
module ranking:
    snakefile:
        "../../Snakefile"
    config:
        # of the overlay: fewer members, and speeds that the smoothing of the bare casing bears
        run(
            "ranking",
            "ranking",
            structure=LINEAR,
            speeds=[{"start": 750, "stop": 2000, "step": 25}],
            tolerances={"members": 4},
        )


use rule * from ranking as ranking_*


use rule evidence as which_blade with:
    input:
        unpack(behind_engine(ranking="results/runs/interactions_quadratic/ranking.csv")),
    output:
        table=f"{TABLES}/which_blade.csv",
    log:
        "logs/validation/which_blade.log",
    params:
        **evidence("which_blade.rankings"),


use rule evidence as which_blade_checks with:
    input:
        unpack(
            behind_engine(
                **{name: f"results/runs/interactions_{name}/ranking.csv" for name in ("standard", "fine", "rotation")}
            )
        ),
    output:
        table=f"{TABLES}/which_blade_checks.csv",
    log:
        "logs/validation/which_blade_checks.log",
    params:
        **evidence("which_blade.checks"),


use rule evidence as which_blade_speeds with:
    input:
        unpack(
            lambda wildcards: behind_engine(
                every=responses("results/runs/campaign", wildcards.scene),
                adaptive=responses("results", wildcards.scene),
            )(wildcards)
        ),
    output:
        table=f"{TABLES}/which_blade_speeds_{{scene}}.csv",
    log:
        "logs/validation/which_blade_speeds_{scene}.log",
    params:
        **evidence("which_blade.speeds"),


use rule evidence as which_blade_adaptive with:
    input:
        unpack(
            behind_engine(
                every=responses("results/runs/campaign", "abradable", "direct"),
                adaptive=responses("results", "abradable", "direct"),
            )
        ),
    output:
        table=f"{TABLES}/which_blade_adaptive.csv",
    log:
        "logs/validation/which_blade_adaptive.log",
    params:
        **evidence("which_blade.adaptive"),


use rule evidence as which_blade_statistic with:
    input:
        unpack(behind_engine(*responses("results/runs/campaign", "direct"))),
    output:
        table=f"{TABLES}/which_blade_statistic.csv",
    log:
        "logs/validation/which_blade_statistic.log",
    params:
        **evidence("which_blade.statistic"),


use rule evidence as which_blade_missed with:
    input:
        unpack(
            behind_engine(
                contacts=[f"results/{blade}/contact_pressure_edge.npz" for blade in BLADES],
                stresses=[f"results/{blade}/stress_pressure_edge.npz" for blade in BLADES],
                responses=responses("results", "abradable", "direct"),
            )
        ),
    output:
        table=f"{TABLES}/which_blade_missed.csv",
    log:
        "logs/validation/which_blade_missed.log",
    params:
        **evidence("which_blade.missed"),


use rule evidence as which_blade_chances with:
    input:
        unpack(behind_engine(ranking="results/runs/ranking/ranking.csv")),
    output:
        table=f"{TABLES}/which_blade_chances.csv",
    log:
        "logs/validation/which_blade_chances.log",
    params:
        **evidence("which_blade.chances"),
