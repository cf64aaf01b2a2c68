# Numbers that stand for the engine. Results behind this checkpoint are made again when a number moves, and not when code is
# rearranged: Snakemake compares the content of the file.


checkpoint engine_numbers:
    input:
        # of files, not a hash: a fresh clone has no record of parameters
        code=[
            str(file.relative_to(ROOT))
            for file in CodeHashes(ROOT / "src", VALIDATION).closure("evidence.engine_numbers")
        ],
        configuration=["config/config.yaml", "config/blades.yaml", "config/scenes.yaml", "config/fidelity.yaml"],
    output:
        update("validation/engine_numbers.json"),
    log:
        "logs/validation/engine_numbers.log",
    conda:
        ROOT / "envs/r37.yaml"
    params:
        step="evidence.engine_numbers.renew",
    script:
        "../step.py"
