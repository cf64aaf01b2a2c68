# Ranges of an interaction under tolerances (docs/tolerances.md).
module tolerances:
    snakefile:
        "../../Snakefile"
    config:
        # fewer members than the overlay
        run("tolerances", "tolerances", structure=LINEAR, tolerances={"members": 8})


use rule * from tolerances as tolerances_*


# one blade at draft, from below the first member's yield to above the last one's peak
module members:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "members",
            "tolerances",
            structure=LINEAR,
            blades=["Ref"],
            fidelity="draft",
            speeds=[{"start": 1650, "stop": 1898, "step": 8}],
            speeds_for=[],
            tolerances={"members": 128},
        )


use rule * from members as members_*


use rule evidence as tolerance_ranges with:
    input:
        unpack(behind_engine(table="results/runs/tolerances/tolerances.csv")),
    output:
        table=f"{TABLES}/tolerance_ranges.csv",
    log:
        "logs/validation/tolerance_ranges.log",
    params:
        **evidence("tolerances.ranges"),


use rule evidence as tolerance_numbers with:
    input:
        unpack(behind_engine(members="results/runs/members/tolerances.nc")),
    output:
        table=f"{TABLES}/tolerance_numbers.csv",
    log:
        "logs/validation/tolerance_numbers.log",
    params:
        **evidence("tolerances.numbers"),


use rule evidence as tolerance_members with:
    input:
        unpack(behind_engine(members="results/runs/members/tolerances.nc")),
    output:
        table=f"{TABLES}/tolerance_members.csv",
    log:
        "logs/validation/tolerance_members.log",
    params:
        **evidence("tolerances.members"),
