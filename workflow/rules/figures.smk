# Pictures of the results.


rule campbell_figure:
    input:
        "results/{blade}/campbell.nc",
    output:
        "results/figures/campbell_{blade}.png",
    log:
        "logs/figures/campbell_{blade}.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figures/style.py", "figures/campbell.py"),
    script:
        "../scripts/campbell_figure.py"


rule campbell_overview:
    input:
        "results/campbell.nc",
    output:
        "results/figures/campbell.png",
    log:
        "logs/figures/campbell_overview.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figures/style.py", "figures/campbell.py"),
    script:
        "../scripts/campbell_overview.py"


rule blade_shapes_figure:
    input:
        expand("results/{blade}/mesh.vtu", blade=settings.blades),
    output:
        "results/figures/blades.png",
    log:
        "logs/figures/blades.log",
    conda:
        ENVIRONMENT
    params:
        blades=list(settings.blades),
        code=code("figures/blade_shapes.py"),
    script:
        "../scripts/blade_shapes_figure.py"
