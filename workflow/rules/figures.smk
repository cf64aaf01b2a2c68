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


rule response_figure:
    input:
        **({"stress": "results/stress.nc"} if "stress" in KINDS else {}),
        campbell="results/campbell.nc",
        rms="results/rms.nc",
    output:
        "results/figures/response_{blade}.png",
    log:
        "logs/figures/response_{blade}.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figures/style.py", "figures/response.py"),
    script:
        "../scripts/response_figure.py"


rule map_figure:
    input:
        campbell="results/campbell.nc",
        maps="results/{kind}.nc",
    output:
        "results/figures/{kind}_{blade}__{scene}.png",
    log:
        "logs/figures/{kind}_{blade}__{scene}.log",
    wildcard_constraints:
        kind="spectrum|wear",
    conda:
        ENVIRONMENT
    params:
        code=code("figures/style.py", "figures/maps.py"),
    script:
        "../scripts/map_figure.py"


rule response_overview:
    input:
        "results/rms.nc",
    output:
        "results/figures/response.png",
    log:
        "logs/figures/response_overview.log",
    conda:
        ENVIRONMENT
    params:
        code=code("figures/style.py", "figures/response.py"),
    script:
        "../scripts/response_overview.py"


SWEEP_FIGURES = [
    "response",
    *expand("response_{blade}", blade=settings.blades),
    *[f"{kind}_{blade}__{scene}" for kind in ("spectrum", "wear") for blade, scene in runs_with(kind)],
]
