# Pictures of the results.


rule campbell_figure:
    input:
        paths.CAMPBELL,
    output:
        report(
            "<results>/figures/campbell_{blade}.png",
            **shown(TEXTS / "figure.rst", "{blade}", EVERY_SCENE, figure="Campbell diagram"),
        ),
    log:
        "<logs>/figures/campbell_{blade}.log",
    conda:
        ENVIRONMENT
    params:
        caption=captioned("campbell"),
        code=code("campbell_figure"),
    script:
        "../scripts/campbell_figure.py"


rule campbell_overview:
    input:
        "<results>/campbell.nc",
    output:
        report(
            "<results>/figures/campbell.png",
            **shown(TEXTS / "figure.rst", TOGETHER, EVERY_SCENE, figure="Campbell diagrams"),
        ),
    log:
        "<logs>/figures/campbell_overview.log",
    conda:
        ENVIRONMENT
    params:
        caption=captioned("campbell_overview"),
        code=code("campbell_overview"),
    script:
        "../scripts/campbell_overview.py"


rule blade_shapes_figure:
    input:
        expand(paths.MESH, blade=imported.with_mesh),
    output:
        report(
            "<results>/figures/blades.png",
            **shown(TEXTS / "figure.rst", TOGETHER, EVERY_SCENE, figure="shapes"),
        ),
    log:
        "<logs>/figures/blades.log",
    conda:
        ENVIRONMENT
    params:
        blades=imported.with_mesh,
        caption=captioned("blades"),
        code=code("blade_shapes_figure"),
    script:
        "../scripts/blade_shapes_figure.py"


rule response_figure:
    input:
        unpack(sweep.response_pictured),
    output:
        report(
            paths.RESPONSE_FIGURE,
            **shown(TEXTS / "figure.rst", "{blade}", EVERY_SCENE, figure="response"),
        ),
    log:
        "<logs>/figures/response_{blade}.log",
    conda:
        ENVIRONMENT
    params:
        caption=captioned("response"),
        code=code("response_figure"),
    script:
        "../scripts/response_figure.py"


rule map_figure:
    input:
        campbell="<results>/campbell.nc",
        maps="<results>/{kind}.nc",
    output:
        report(
            paths.MAP_FIGURE,
            **shown(TEXTS / "figure.rst", "{blade}", "{scene}", figure="{kind}"),
        ),
    log:
        "<logs>/figures/{kind}_{blade}__{scene}.log",
    wildcard_constraints:
        kind="spectrum|wear",
    conda:
        ENVIRONMENT
    params:
        caption=captioned(),
        code=code("map_figure"),
    script:
        "../scripts/map_figure.py"


rule response_overview:
    input:
        "<results>/rms.nc",
    output:
        report(
            "<results>/figures/response.png",
            **shown(TEXTS / "figure.rst", TOGETHER, EVERY_SCENE, figure="responses"),
        ),
    log:
        "<logs>/figures/response_overview.log",
    conda:
        ENVIRONMENT
    params:
        caption=captioned("response_overview"),
        code=code("response_overview"),
    script:
        "../scripts/response_overview.py"
