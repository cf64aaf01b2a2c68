# What a clearance that changes with the speed changes (docs/clearance.md).
module clearance:
    snakefile:
        "../../Snakefile"
    config:
        run("clearance", "clearance", scenes=["abradable", "growing_abradable", "total_stress"])


use rule * from clearance as clearance_*


CLEARANCE = "results/runs/clearance"


use rule evidence as clearance_tip with:
    input:
        unpack(
            behind_engine(
                campbell=f"{CLEARANCE}/campbell.nc",
                contacts=[f"{CLEARANCE}/{blade}/contact_pressure_edge.npz" for blade in BLADES],
                models=[f"{CLEARANCE}/{blade}/rom_pressure_edge.nc" for blade in BLADES],
                meshes=[f"{CLEARANCE}/{blade}/mesh.vtu" for blade in BLADES],
            )
        ),
    output:
        table=f"{TABLES}/clearance_tip.csv",
    log:
        "logs/validation/clearance_tip.log",
    params:
        **evidence("clearance.tip"),


use rule evidence as clearance_effect with:
    input:
        unpack(behind_engine(**{kind: f"{CLEARANCE}/{kind}.nc" for kind in ("campbell", "rms", "stress")})),
    output:
        table=f"{TABLES}/clearance_effect.csv",
    log:
        "logs/validation/clearance_effect.log",
    params:
        **evidence("clearance.effect"),


# lobes of a height in mm against lobes of two clearances, on models of the main job and of that on patches
LOBE_MODELS = {"points": "results", "patches": "results/runs/patches"}


use rule evidence as clearance_lobes_of_blade with:
    input:
        unpack(
            lambda wildcards: behind_engine(
                **models_of(wildcards.blade, LOBE_MODELS[wildcards.contact]),
                campbell=f"{LOBE_MODELS[wildcards.contact]}/{wildcards.blade}/campbell.nc",
            )(wildcards)
        ),
    output:
        "results/evidence/clearance_lobes_{contact}_{blade}.csv",
    log:
        "logs/validation/clearance_lobes_{contact}_{blade}.log",
    wildcard_constraints:
        contact="|".join(LOBE_MODELS),
    params:
        **evidence("lobes.lengths_of_blade"),
        blade=lambda wildcards: wildcards.blade,
        contact=lambda wildcards: wildcards.contact,


use rule evidence as clearance_lobes with:
    input:
        unpack(
            behind_engine(
                *[
                    f"results/evidence/clearance_lobes_{contact}_{blade}.csv"
                    for contact in LOBE_MODELS
                    for blade in ("Ref", "CS50", "L100")
                ]
            )
        ),
    output:
        table=f"{TABLES}/clearance_lobes.csv",
    log:
        "logs/validation/clearance_lobes.log",
    params:
        **evidence("lobes.lengths"),
