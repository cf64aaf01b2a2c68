# What accuracy costs: levels, mesh, contact on points and patches, step, modes, revolutions (docs/accuracy.md).
ACCURACY = "results/validation/accuracy"
WORST = ["Ref", "S50", "CS100"]  # at every level, of all blades
MESHES = {5000: BLADES, 10000: [*WORST, "S100"], 20000: BLADES, 40000: WORST, 60000: BLADES}
accuracy_runs = [f"{ACCURACY}/{blade}_{nodes}.csv" for nodes, blades in MESHES.items() for blade in blades]


use rule evidence as accuracy_standard with:
    input:
        unpack(behind_engine()),
    output:
        f"{ACCURACY}/{{blade}}_20000.csv",
    log:
        "logs/validation/accuracy_{blade}_20000.log",
    priority: 2
    params:
        **evidence("contact_runs.standard"),
        blade=lambda wildcards: wildcards.blade,


use rule evidence as accuracy_on_mesh with:
    input:
        unpack(behind_engine(standard=f"{ACCURACY}/{{blade}}_20000.csv")),
    output:
        f"{ACCURACY}/{{blade}}_{{nodes}}.csv",
    log:
        "logs/validation/accuracy_{blade}_{nodes}.log",
    wildcard_constraints:
        nodes="5000|10000|40000|60000",
    priority: 1
    params:
        **evidence("contact_runs.on_mesh"),
        blade=lambda wildcards: wildcards.blade,
        nodes=lambda wildcards: int(wildcards.nodes),


use rule evidence as accuracy_levels with:
    input:
        unpack(behind_engine(*accuracy_runs)),
    output:
        levels=f"{TABLES}/accuracy_levels.csv",
        steep=f"{TABLES}/accuracy_steep.csv",
        blades=f"{TABLES}/accuracy_levels_blades.csv",
    log:
        "logs/validation/accuracy_levels.log",
    params:
        **evidence("accuracy.levels"),


use rule evidence as accuracy_convergence with:
    input:
        unpack(behind_engine(*accuracy_runs)),
    output:
        mesh=f"{TABLES}/accuracy_mesh.csv",
        motion=f"{TABLES}/accuracy_motion.csv",
        stress=f"{TABLES}/accuracy_stress.csv",
    log:
        "logs/validation/accuracy_convergence.log",
    params:
        **evidence("accuracy.convergence"),


use rule evidence as accuracy_chance with:
    input:
        unpack(behind_engine(*[file for file in accuracy_runs if file.endswith("_20000.csv")])),
    output:
        table=f"{TABLES}/accuracy_chance.csv",
        friction=f"{TABLES}/accuracy_friction.csv",
    log:
        "logs/validation/accuracy_chance.log",
    params:
        **evidence("accuracy.chance"),


use rule evidence as accuracy_patches with:
    input:
        unpack(behind_engine(*accuracy_runs)),
    output:
        blades=f"{TABLES}/accuracy_patches_blades.csv",
        published=f"{TABLES}/accuracy_published_direct.csv",
        stiffness=f"{TABLES}/accuracy_stiff_linings.csv",
        peaks=f"{TABLES}/accuracy_published_peaks.csv",
    log:
        "logs/validation/accuracy_patches.log",
    params:
        **evidence("accuracy.patches"),


use rule evidence as accuracy_picture with:
    input:
        unpack(behind_engine(*accuracy_runs)),
    output:
        picture="docs/contact_patches.png",
    log:
        "logs/validation/accuracy_picture.log",
    params:
        **evidence("accuracy.draw"),


# penetration of the edge between contact nodes, and the limit in the mesh of the patches that are closer towards the edges
use rule evidence as penetration_of_blade with:
    input:
        unpack(behind_engine()),
    output:
        "results/evidence/penetration_{blade}.csv",
    log:
        "logs/validation/penetration_{blade}.log",
    wildcard_constraints:
        blade="|".join(BLADES),
    params:
        **evidence("penetration.runs_of_blade"),
        blade=lambda wildcards: wildcards.blade,


use rule evidence as penetration with:
    input:
        unpack(behind_engine(*[f"results/evidence/penetration_{blade}.csv" for blade in BLADES])),
    output:
        table=f"{TABLES}/penetration.csv",
        rms=f"{TABLES}/penetration_rms.csv",
        picture="docs/penetration.png",
    log:
        "logs/validation/penetration.log",
    params:
        **evidence("penetration.penetration"),


use rule evidence as penetration_mesh_of_blade with:
    input:
        unpack(behind_engine()),
    output:
        "results/evidence/penetration_mesh_{blade}.csv",
    log:
        "logs/validation/penetration_mesh_{blade}.log",
    params:
        **evidence("penetration.mesh_runs_of_blade"),
        blade=lambda wildcards: wildcards.blade,


use rule evidence as penetration_mesh with:
    input:
        unpack(behind_engine(*[f"results/evidence/penetration_mesh_{blade}.csv" for blade in ("S100", "S50", "CS50")])),
    output:
        table=f"{TABLES}/penetration_mesh.csv",
    log:
        "logs/validation/penetration_mesh.log",
    params:
        **evidence("penetration.mesh_limit"),


use rule evidence as penetration_cost with:
    input:
        unpack(behind_engine()),
    output:
        table=f"{TABLES}/penetration_cost.csv",
    log:
        "logs/validation/penetration_cost.log",
    params:
        **evidence("penetration.cost"),


# what adaptive speeds find, replayed in the runs of every speed
use rule evidence as adaptive_speeds with:
    input:
        unpack(
            behind_engine(
                *responses("results/runs/campaign", "abradable", "direct"),
                campbell="results/runs/campaign/campbell.nc",
            )
        ),
    output:
        table=f"{TABLES}/adaptive_speeds.csv",
        blades=f"{TABLES}/adaptive_speeds_blades.csv",
        missed=f"{TABLES}/adaptive_speeds_missed.csv",
    log:
        "logs/validation/adaptive_speeds.log",
    params:
        **evidence("adaptive_speeds.tables"),


# stress of the airfoil against the highest frequency kept, damping of high modes, step, patches and elastic casing
use rule evidence as stress_band_runs with:
    input:
        unpack(behind_engine()),
    output:
        "results/evidence/stress_band.csv",
    log:
        "logs/validation/stress_band_runs.log",
    params:
        **evidence("stress_band.runs"),


use rule evidence as stress_band with:
    input:
        unpack(behind_engine("results/evidence/stress_band.csv")),
    output:
        table=f"{TABLES}/stress_band.csv",
        picture="docs/stress_band.png",
    log:
        "logs/validation/stress_band.log",
    params:
        **evidence("stress_band.table_and_picture"),
