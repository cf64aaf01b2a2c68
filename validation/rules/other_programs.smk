# The time integration against programs that share no code with it (docs/validation.md).
import os

blade_of_other_programs = {"model": "results/Ref/contact_pressure_edge.npz"}


use rule evidence as other_programs_elastic with:
    input:
        unpack(behind_engine(**blade_of_other_programs)),
    output:
        table=f"{TABLES}/other_programs_elastic.csv",
    log:
        "logs/validation/other_programs_elastic.log",
    params:
        **evidence("other_programs.elastic"),


use rule evidence as other_programs_worn with:
    input:
        unpack(behind_engine(**blade_of_other_programs)),
    output:
        table=f"{TABLES}/other_programs_worn.csv",
    log:
        "logs/validation/other_programs_worn.log",
    params:
        **evidence("other_programs.worn"),


use rule evidence as other_programs_material with:
    input:
        unpack(
            behind_engine(
                points="results/Ref/contact_pressure_edge.npz",
                patches="results/runs/patches/Ref/contact_pressure_edge.npz",
                other="results/CS50/contact_pressure_edge.npz",
            )
        ),
    output:
        table=f"{TABLES}/other_programs_material.csv",
    log:
        "logs/validation/other_programs_material.log",
    params:
        **evidence("other_programs.material"),


use rule evidence as other_programs_direct with:
    input:
        unpack(behind_engine(**blade_of_other_programs)),
    output:
        table=f"{TABLES}/other_programs_direct.csv",
    log:
        "logs/validation/other_programs_direct.log",
    params:
        **evidence("other_programs.direct"),


# NLstep is another group's program, in GNU Octave: NLSTEP=/path/to/NLstep. Without it the tables in the repository stay
if "NLSTEP" in os.environ:

    use rule evidence as other_programs_histories with:
        input:
            unpack(behind_engine(**blade_of_other_programs)),
        output:
            table=f"{TABLES}/other_programs_histories.csv",
        log:
            "logs/validation/other_programs_histories.log",
        params:
            **evidence("other_programs.histories"),

    use rule evidence as other_programs_rms with:
        input:
            unpack(behind_engine(**blade_of_other_programs)),
        output:
            table=f"{TABLES}/other_programs_rms.csv",
        log:
            "logs/validation/other_programs_rms.log",
        params:
            **evidence("other_programs.rms"),
