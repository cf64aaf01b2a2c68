# Numbers that stand for the engine. Results behind this checkpoint are made again when a number moves, and not when code is
# rearranged: Snakemake compares the content of the file.


ENGINE = "validation/engine_numbers.json"


checkpoint engine_numbers:
    output:
        update(ENGINE),
    log:
        "logs/validation/engine_numbers.log",
    conda:
        ROOT / "envs/r37.yaml"
    params:
        step="evidence.engine_numbers.renew",
        code=CodeHashes(ROOT / "src", VALIDATION)("evidence.engine_numbers"),
    script:
        "../step.py"
