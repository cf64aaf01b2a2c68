# The datasets over all blades and scenes, and the list of interactions.


rule sweep_dataset:
    input:
        lambda wildcards: [f"results/{blade}/{scene}/response.nc" for blade, scene in runs_with(wildcards.kind)],
    output:
        "results/{kind}.nc",
    log:
        "logs/dataset_{kind}.log",
    wildcard_constraints:
        kind="|".join(KINDS),
    conda:
        ENVIRONMENT
    params:
        runs=lambda wildcards: runs_with(wildcards.kind),
        fidelity=settings.fidelity_name,
        code=code("io.py", "results/datasets.py", "results/netcdf.py", "results/variables.py"),
    script:
        "../scripts/sweep_dataset.py"


rule summary:
    input:
        **{kind: f"results/{kind}.nc" for kind in KINDS},
        campbell="results/campbell.nc",
    output:
        "results/summary.csv",
    log:
        "logs/summary.log",
    conda:
        ENVIRONMENT
    params:
        choice=plain(settings.interactions),
        code=code("results/interactions.py"),
    script:
        "../scripts/summary.py"
