# Pictures of the results.


rule campbell_figure:
    input:
        paths.CAMPBELL,
    output:
        "<results>/figures/campbell_{blade}.png",
    log:
        "<logs>/figures/campbell_{blade}.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("campbell_figure"),
    params:
        code=code("campbell_figure"),
    script:
        "../scripts/campbell_figure.py"


rule campbell_overview:
    input:
        "<results>/campbell.nc",
    output:
        "<results>/figures/campbell.png",
    log:
        "<logs>/figures/campbell_overview.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("campbell_overview"),
    params:
        code=code("campbell_overview"),
    script:
        "../scripts/campbell_overview.py"


rule blade_shapes_figure:
    input:
        expand(paths.MESH, blade=imported.with_mesh),
    output:
        "<results>/figures/blades.png",
    log:
        "<logs>/figures/blades.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("blade_shapes_figure"),
    params:
        blades=imported.with_mesh,
        code=code("blade_shapes_figure"),
    script:
        "../scripts/blade_shapes_figure.py"


rule response_figure:
    input:
        unpack(sweep.response_pictured),
    output:
        paths.RESPONSE_FIGURE,
    log:
        "<logs>/figures/response_{blade}.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("response_figure"),
    params:
        code=code("response_figure"),
    script:
        "../scripts/response_figure.py"


rule map_figure:
    input:
        campbell="<results>/campbell.nc",
        maps="<results>/{kind}.nc",
    output:
        paths.MAP_FIGURE,
    log:
        "<logs>/figures/{kind}_{blade}__{scene}.log",
    wildcard_constraints:
        kind="spectrum|wear",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("map_figure"),
    params:
        code=code("map_figure"),
    script:
        "../scripts/map_figure.py"


rule response_overview:
    input:
        "<results>/rms.nc",
    output:
        "<results>/figures/response.png",
    log:
        "<logs>/figures/response_overview.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("response_overview"),
    params:
        code=code("response_overview"),
    script:
        "../scripts/response_overview.py"
