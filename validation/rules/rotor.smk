# Whole rotors (docs/rotor.md).
from evidence.rotor import KINDS


module rotors:
    snakefile:
        "../../Snakefile"
    config:
        run("rotors", "rotor")


use rule * from rotors as rotors_*


ROTOR_KINDS = {"Ref": (1648, 1808), "S100": (1600, 1760)}


# about the crossing of 1B with engine order 4 alone
module rotor_kinds:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "rotor_kinds",
            scenes_file="validation/rotors.yaml",
            scenes="all",
            blades=list(ROTOR_KINDS),
            speeds_for=[
                {"blades": [blade], "speeds": [{"start": start, "stop": stop, "step": 8}]}
                for blade, (start, stop) in ROTOR_KINDS.items()
            ],
        )


use rule * from rotor_kinds as rotor_kinds_*


use rule evidence as rotor_blades with:
    input:
        unpack(
            behind_engine(
                singles=responses("results/runs/rotors", "abradable"),
                rotors=[f"results/runs/rotors/{blade}/rotor_abradable/rotor.nc" for blade in BLADES],
                campbells=[f"results/runs/rotors/{blade}/campbell.nc" for blade in BLADES],
            )
        ),
    output:
        table=f"{TABLES}/rotor.csv",
    log:
        "logs/validation/rotor_blades.log",
    params:
        **evidence("rotor.blades"),


use rule evidence as rotor_kinds with:
    input:
        unpack(
            behind_engine(
                *[
                    f"results/runs/rotor_kinds/{blade}/{kind}/{'response' if kind == 'single' else 'rotor'}.nc"
                    for blade in ROTOR_KINDS
                    for kind in KINDS
                ]
            )
        ),
    output:
        table=f"{TABLES}/rotor_kinds.csv",
    log:
        "logs/validation/rotor_kinds.log",
    params:
        **evidence("rotor.kinds"),


use rule copy as rotor_picture with:
    input:
        unpack(behind_engine("results/runs/rotors/figures/rotor_Ref__rotor_abradable.png")),
    output:
        "docs/rotor.png",
    log:
        "logs/validation/rotor_picture.log",
