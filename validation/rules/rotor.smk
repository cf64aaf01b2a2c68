# Whole rotors (docs/rotor.md).
from evidence.rotor import KINDS


module rotors:
    snakefile:
        "../../Snakefile"
    config:
        # fewer speeds than the overlay
        run("rotors", "rotor", structure=LINEAR, speeds=[{"start": 1250, "stop": 1830, "step": 12}])


use rule * from rotors as rotors_*


ROTOR_BLADES = ("Ref", "S100")
# about crossings of 1B, the second one of Ref for equal blades alone
ROTOR_WINDOWS = {"Ref, 1B/4": ("Ref", 1648, 1808), "Ref, 1B/5": ("Ref", 1250, 1402), "S100, 1B/4": ("S100", 1600, 1760)}


def rotor_speeds(*windows):
    return [{"start": start, "stop": stop, "step": 8} for _, start, stop in map(ROTOR_WINDOWS.get, windows)]


module rotor_kinds:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "rotor_kinds",
            scenes_file="validation/rotors.yaml",
            scenes="all",
            blades=list(ROTOR_BLADES),
            speeds=rotor_speeds("Ref, 1B/4"),
            speeds_for=[
                {"blades": ["S100"], "speeds": rotor_speeds("S100, 1B/4")},
                {"blades": ["Ref"], "scenes": ["single", "equal"], "speeds": rotor_speeds("Ref, 1B/4", "Ref, 1B/5")},
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
                    for blade in ROTOR_BLADES
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
        windows=ROTOR_WINDOWS,


use rule evidence as rotor_grid with:
    input:
        unpack(behind_engine(contact="results/Ref/contact_pressure_edge.npz")),
    output:
        table=f"{TABLES}/rotor_grid.csv",
    log:
        "logs/validation/rotor_grid.log",
    params:
        **evidence("rotor_grid.grid"),
