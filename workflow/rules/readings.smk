

rule readings:
    input:
        [file for reading in READINGS for file in reading_files(reading)],
        [blade_campbell(blade) for blade in PUBLISHED_BLADES],
        [blade_campbell("Ref", nodes) for nodes in (10000, 40000)],
        geometry="results/Ref/geometry.nc",
    output:
        validation="results/studies/validation.md",
    log:
        "logs/studies/readings.log",
    conda:
        ENVIRONMENT
    script:
        "../scripts/validation.py"
