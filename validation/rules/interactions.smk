# Which interactions are dangerous (docs/interactions.md): by linear and by second-order motion, on the same speeds.
DRAFT_SPEEDS = [{"start": 750, "stop": 2000, "step": 10, "refine_to": 2.5}]


def dangers(name, kinematics, fidelity="draft", speeds=DRAFT_SPEEDS, **keys):
    """Configuration of a run of all blades on patches."""
    return run(
        f"interactions_{name}",
        "patches",
        structure={"boundary": {"contact": "patches"}, "kinematics": kinematics},
        fidelity=fidelity,
        speeds=speeds,
        **keys,
    )


# motions carried up and down the speeds, which are not dwelt on
CARRIED = {
    "from_rad_s": 750,
    "to_rad_s": 2000,
    "step_rad_s": 10,
    "dwell": {"range_speeds": 0},
}


module interactions_linear:
    snakefile:
        "../../Snakefile"
    config:
        dangers("linear", "linear", second_motions=CARRIED)


use rule * from interactions_linear as interactions_linear_*


module interactions_quadratic:
    snakefile:
        "../../Snakefile"
    config:
        dangers("quadratic", "quadratic", second_motions=CARRIED)


use rule * from interactions_quadratic as interactions_quadratic_*


module interactions_longer:
    snakefile:
        "../../Snakefile"
    config:
        dangers(
            "longer",
            "quadratic",
            scenes_file="validation/longer.yaml",
            scenes=["twice_abradable", "twice_direct"],
        )


use rule * from interactions_longer as interactions_longer_*


# the same at the next level, with speeds down to half as far apart
module interactions_standard:
    snakefile:
        "../../Snakefile"
    config:
        dangers(
            "standard",
            "quadratic",
            fidelity="standard",
            speeds=[{"start": 750, "stop": 2000, "step": 10, "refine_to": 1.25}],
            second_motions=CARRIED,
        )


use rule * from interactions_standard as interactions_standard_*


# adaptive speeds stay as far apart on the bare casing, so these are half as far by themselves
module interactions_fine:
    snakefile:
        "../../Snakefile"
    config:
        dangers(
            "fine",
            "quadratic",
            fidelity="standard",
            scenes=["direct"],
            speeds=[{"start": 750, "stop": 2000, "step": 5}],
        )


use rule * from interactions_fine as interactions_fine_*


# and with the stress of rotation
module interactions_rotation:
    snakefile:
        "../../Snakefile"
    config:
        dangers(
            "rotation",
            "quadratic",
            scenes_file="validation/longer.yaml",
            scenes=["material_abradable", "direct"],
        )


use rule * from interactions_rotation as interactions_rotation_*


# and carried motions with twice the revolutions
module interactions_lasting:
    snakefile:
        "../../Snakefile"
    config:
        dangers(
            "lasting",
            "quadratic",
            scenes_file="validation/longer.yaml",
            scenes=["twice_abradable"],
            speeds=[{"start": 750, "stop": 2000, "step": 10}],
            second_motions=CARRIED | {"revolutions": 200},
        )


use rule * from interactions_lasting as interactions_lasting_*


RUNS = [f"results/runs/interactions_{name}" for name in ("linear", "quadratic", "longer")]


use rule evidence as interactions with:
    input:
        unpack(
            behind_engine(
                summaries=[f"{folder}/summary.csv" for folder in RUNS],
                rankings=[f"{folder}/ranking.csv" for folder in RUNS],
            )
        ),
    output:
        lining=f"{TABLES}/interactions_lining.csv",
        bare=f"{TABLES}/interactions_bare.csv",
        every=f"{TABLES}/interactions_every.csv",
    log:
        "logs/validation/interactions.log",
    params:
        **evidence("interactions.worst"),


use rule evidence as interactions_ranges with:
    input:
        unpack(
            behind_engine(
                draft=f"{RUNS[1]}/second_motions.nc",
                standard="results/runs/interactions_standard/second_motions.nc",
            )
        ),
    output:
        table=f"{TABLES}/interactions_ranges.csv",
    log:
        "logs/validation/interactions_ranges.log",
    params:
        **evidence("interactions.ranges"),


use rule evidence as interactions_lasting with:
    input:
        unpack(behind_engine(motions="results/runs/interactions_lasting/second_motions.nc")),
    output:
        table=f"{TABLES}/interactions_lasting.csv",
    log:
        "logs/validation/interactions_lasting.log",
    params:
        **evidence("interactions.lasting"),


# the first picture of README
use rule evidence as answer with:
    input:
        unpack(behind_engine(linear=f"{RUNS[0]}/ranking.csv", quadratic=f"{RUNS[1]}/ranking.csv")),
    output:
        table=f"{TABLES}/answer.csv",
        picture="docs/answer.png",
    log:
        "logs/validation/answer.log",
    params:
        **evidence("answer.draw"),
