# Motions that a start from rest does not show (docs/second_motions.md), on points and on patches.
module motions_points:
    snakefile:
        "../../Snakefile"
    config:
        run("motions_points", "second_motions")


use rule * from motions_points as motions_points_*


module motions_patches:
    snakefile:
        "../../Snakefile"
    config:
        overlay(
            ROOT,
            "patches",
            "second_motions",
            # on a lining over all of the tip most speeds are in some range
            second_motions={"dwell": {"range_speeds": 1}},
            run={"name": "motions_patches", "engine": "validation/engine_numbers.json"},
        )


use rule * from motions_patches as motions_patches_*


MOTIONS = {contact: f"results/runs/motions_{contact}" for contact in ("points", "patches")}


use rule evidence as second_motions with:
    input:
        unpack(
            behind_engine(
                **{contact: f"{folder}/second_motions.nc" for contact, folder in MOTIONS.items()},
                ranges=[f"{folder}/second_motions.csv" for folder in MOTIONS.values()],
                dwells=[f"{folder}/second_motions_dwells.csv" for folder in MOTIONS.values()],
            )
        ),
    output:
        table=f"{TABLES}/second_motions.csv",
        ranges=f"{TABLES}/second_motions_ranges.csv",
        ranking=f"{TABLES}/second_motions_ranking.csv",
    log:
        "logs/validation/second_motions.log",
    params:
        **evidence("second_motions.tables"),


use rule evidence as second_motions_kinds with:
    input:
        unpack(
            behind_engine(
                **{
                    contact: [f"{folder}/{blade}/direct/second_motions_rest.npz" for blade in BLADES]
                    for contact, folder in MOTIONS.items()
                },
                **{
                    f"{contact}_models": [f"{folder}/{blade}/contact_pressure_edge.npz" for blade in BLADES]
                    for contact, folder in MOTIONS.items()
                },
            )
        ),
    output:
        table=f"{TABLES}/second_motions_kinds.csv",
    log:
        "logs/validation/second_motions_kinds.log",
    params:
        **evidence("second_motions.kinds"),


use rule evidence as second_motions_switching with:
    input:
        unpack(
            behind_engine(
                model=f"{MOTIONS['points']}/Ref/contact_pressure_edge.npz",
                states=expand(
                    f"{MOTIONS['points']}/Ref/direct/second_motions_{{motion}}.npz", motion=["up", "down", "rest"]
                ),
            )
        ),
    output:
        table=f"{TABLES}/second_motions_switching.csv",
    log:
        "logs/validation/second_motions_switching.log",
    params:
        **evidence("second_motions.switching"),


use rule evidence as second_motions_harmonic_balance with:
    input:
        unpack(
            behind_engine(
                models=[f"{MOTIONS['points']}/{blade}/contact_pressure_edge.npz" for blade in ("Ref", "L50", "CS100")]
            ),
        ),
    output:
        table=f"{TABLES}/second_motions_harmonic_balance.csv",
    log:
        "logs/validation/second_motions_harmonic_balance.log",
    params:
        **evidence("harmonic_balance.held"),


use rule evidence as second_motions_again with:
    input:
        unpack(
            behind_engine(
                models=[f"{MOTIONS['points']}/{blade}/contact_pressure_edge.npz" for blade in ("CS100", "S50")],
                states=[
                    f"{MOTIONS['points']}/{blade}/direct/second_motions_{motion}.npz"
                    for blade in ("CS100", "S50")
                    for motion in ("up", "rest")
                ],
            )
        ),
    output:
        table=f"{TABLES}/second_motions_again.csv",
    log:
        "logs/validation/second_motions_again.log",
    params:
        **evidence("second_motions.again"),
