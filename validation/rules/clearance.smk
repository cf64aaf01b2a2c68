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
