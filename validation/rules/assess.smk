# A fan blade of another program, judged and attacked by the commands of docs/assess.md.
use rule evidence as assess with:
    input:
        unpack(behind_engine(fan=sorted(map(str, Path("examples/fan").glob("*"))))),
    output:
        table=f"{TABLES}/assess.csv",
        map="docs/assess_map.png",
        stress="docs/assess_stress.png",
    log:
        "logs/validation/assess.log",
    threads: workflow.cores
    params:
        **evidence("assess.verdicts"),
        # no input: the page itself is made of the table
        page="docs/assess.md",


# A made-up test of the fan, the numbers that it asks for, and the verdict with them, by the commands of docs/measurement.md.
use rule evidence as measurement with:
    input:
        unpack(behind_engine(fan=sorted(map(str, Path("examples/fan").glob("*"))))),
    output:
        table=f"{TABLES}/measurement.csv",
        picture="docs/measurement.png",
    log:
        "logs/validation/measurement.log",
    threads: workflow.cores
    params:
        **evidence("assess.measurement"),
        # no input: the page itself is made of the table
        page="docs/measurement.md",
