# The lining by its material: its limit in bars, step, contact nodes and mesh, and what the contact length does (docs/lining.md).


use rule evidence as lining_limits_of_blade with:
    input:
        unpack(behind_engine()),
    output:
        "results/evidence/lining_limits_{blade}.csv",
    log:
        "logs/validation/lining_limits_{blade}.log",
    params:
        **evidence("lining.limits_of_blade"),
        blade=lambda wildcards: wildcards.blade,


use rule evidence as lining_limits with:
    input:
        unpack(behind_engine(*[f"results/evidence/lining_limits_{blade}.csv" for blade in ("Ref", "CS50", "L100")])),
    output:
        table=f"{TABLES}/lining_limits.csv",
    log:
        "logs/validation/lining_limits.log",
    params:
        **evidence("lining.limits"),


use rule evidence as lining_own_blade with:
    input:
        unpack(behind_engine()),
    output:
        table=f"{TABLES}/lining_own_blade.csv",
    log:
        "logs/validation/lining_own_blade.log",
    params:
        **evidence("lining.own_blade"),


# blades with large displacements, of the run of interactions.smk
LARGE_MOTION = "results/runs/interactions_quadratic"


use rule evidence as lining_contact_length_of_blade with:
    input:
        unpack(lambda wildcards: behind_engine(**models_of(wildcards.blade, LARGE_MOTION))(wildcards)),
    output:
        "results/evidence/lining_contact_length_{blade}.csv",
    log:
        "logs/validation/lining_contact_length_{blade}.log",
    params:
        **evidence("lining.contact_lengths_of_blade"),
        blade=lambda wildcards: wildcards.blade,


use rule evidence as lining_contact_length with:
    input:
        unpack(behind_engine(*[f"results/evidence/lining_contact_length_{blade}.csv" for blade in BLADES])),
    output:
        table=f"{TABLES}/lining_contact_length.csv",
        picture="docs/lining_contact_length.png",
    log:
        "logs/validation/lining_contact_length.log",
    params:
        **evidence("lining.contact_lengths"),
