# What large displacements change (docs/large_motion.md).
def displaced(kinematics):
    """Configuration of a run of each kinematics."""
    return run(
        kinematics,
        scenes=["material_abradable", "direct"],
        fidelity="draft",
        structure={"boundary": {"contact": "patches"}, "kinematics": kinematics},
        speeds=[{"start": 760, "stop": 2000, "step": 20}],
    )


module linear:
    snakefile:
        "../../Snakefile"
    config:
        displaced("linear")


use rule * from linear as linear_*


module rotating:
    snakefile:
        "../../Snakefile"
    config:
        displaced("rotating")


use rule * from rotating as rotating_*


module quadratic:
    snakefile:
        "../../Snakefile"
    config:
        displaced("quadratic")


use rule * from quadratic as quadratic_*


KINEMATICS = ("linear", "rotating", "quadratic")


use rule evidence as large_motion with:
    input:
        unpack(
            behind_engine(
                **{kind: responses(f"results/runs/{kind}", "material_abradable", "direct") for kind in KINEMATICS},
            )
        ),
    output:
        table=f"{TABLES}/large_motion.csv",
        picture="docs/large_motion.png",
    log:
        "logs/validation/large_motion.log",
    params:
        **evidence("large_motion.changes"),
