# Pictures of the results.


rule campbell_figure:
    input:
        paths.CAMPBELL,
    output:
        png=report(
            "<results>/figures/campbell_{blade}.png",
            **shown(TEXTS / "figure.rst", "{blade}", EVERY_SCENE, figure="Campbell diagram"),
        ),
        pdf="<results>/figures/campbell_{blade}.pdf",
    log:
        "<logs>/figures/campbell_{blade}.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("campbell_figure"),
    params:
        caption=captioned("campbell"),
        code=code("campbell_figure"),
    script:
        "../scripts/campbell_figure.py"


rule campbell_overview:
    input:
        "<results>/campbell.nc",
    output:
        png=report(
            "<results>/figures/campbell.png",
            **shown(TEXTS / "figure.rst", TOGETHER, EVERY_SCENE, figure="Campbell diagrams"),
        ),
        pdf="<results>/figures/campbell.pdf",
    log:
        "<logs>/figures/campbell_overview.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("campbell_overview"),
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
    resources:
        **needs.of("blade_shapes_figure"),
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
        png=report(
            paths.RESPONSE_FIGURE,
            **shown(TEXTS / "figure.rst", "{blade}", EVERY_SCENE, figure="response"),
        ),
        pdf=paths.as_pdf(paths.RESPONSE_FIGURE),
    log:
        "<logs>/figures/response_{blade}.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("response_figure"),
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
        png=report(
            paths.MAP_FIGURE,
            **shown(TEXTS / "figure.rst", "{blade}", "{scene}", figure="{kind}"),
        ),
        pdf=paths.as_pdf(paths.MAP_FIGURE),
    log:
        "<logs>/figures/{kind}_{blade}__{scene}.log",
    wildcard_constraints:
        kind="spectrum|wear",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("map_figure"),
    params:
        caption=captioned(),
        code=code("map_figure"),
    script:
        "../scripts/map_figure.py"


rule response_overview:
    input:
        "<results>/rms.nc",
    output:
        png=report(
            "<results>/figures/response.png",
            **shown(TEXTS / "figure.rst", TOGETHER, EVERY_SCENE, figure="responses"),
        ),
        pdf="<results>/figures/response.pdf",
    log:
        "<logs>/figures/response_overview.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("response_overview"),
    params:
        caption=captioned("response_overview"),
        code=code("response_overview"),
    script:
        "../scripts/response_overview.py"


rule waterfall_figure:
    input:
        campbell="<results>/campbell.nc",
        spectrum="<results>/spectrum.nc",
    output:
        png=report(
            paths.WATERFALL_FIGURE,
            **shown(TEXTS / "figure.rst", "{blade}", "{scene}", figure="waterfall"),
        ),
        pdf=paths.as_pdf(paths.WATERFALL_FIGURE),
    log:
        "<logs>/figures/waterfall_{blade}__{scene}.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("map_figure"),
    params:
        caption=captioned("waterfall"),
        code=code("waterfall_figure"),
    script:
        "../scripts/waterfall_figure.py"


rule comparison_figure:
    input:
        unpack(sweep.compared),
    output:
        png=report(
            paths.COMPARISON_FIGURE,
            **shown(TEXTS / "figure.rst", TOGETHER, "{scene}", figure="around an interaction"),
        ),
        pdf=paths.as_pdf(paths.COMPARISON_FIGURE),
    log:
        "<logs>/figures/comparison_{scene}.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("response_overview"),
    params:
        caption=captioned("comparison"),
        code=code("comparison_figure"),
    script:
        "../scripts/comparison_figure.py"
