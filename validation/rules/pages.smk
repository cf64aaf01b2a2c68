TUTORIAL = "docs/tutorial.ipynb"


# with jupytext and the kernel of `make tutorial`
rule tutorial:
    input:
        unpack(behind_engine(ancient("docs/tutorial.py"))),
    output:
        update(TUTORIAL),
    log:
        "logs/validation/tutorial.log",
    conda:
        ROOT / "envs/r37.yaml"
    shell:
        "python validation/tutorial.py > {log:q} 2>&1"


# Tables go into the pages between <!-- table NAME --> and <!-- end -->, each from validation/tables/NAME.csv.


use rule evidence as page with:
    input:
        unpack(lambda wildcards: behind_engine(*pages.tables(f"{wildcards.page}.md"))(wildcards)),
    output:
        update("{page}.md"),
    log:
        "logs/validation/{page}.log",
    wildcard_constraints:
        page="README|docs/[a-z_]+",
    params:
        **evidence("pages.renew"),
