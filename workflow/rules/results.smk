# The datasets over all blades and scenes, and the list of interactions.


rule configuration:
    output:
        report(
            "<results>/configuration.json",
            **shown(TEXTS / "configuration.rst", "Configuration", EVERY_SCENE, figure="configuration"),
        ),
    log:
        "<logs>/configuration.log",
    priority: 20
    conda:
        ENVIRONMENT
    resources:
        **needs.of("configuration"),
    params:
        merged=settings.merged(),
        code=code("configuration"),
    script:
        "../scripts/configuration.py"


# all that lies in the folders of the blades: what runs on several machines at once make (docs/cluster.md), and a rule for --batch
rule responses:
    input:
        expand(rules.campbell_of_blade.output, blade=settings.blades),
        paths.filled({rules.response.output[0]: paths.of_runs(sweep.runs_with("rms"))}),
        sweep.first_rounds,
        simulated(sweep),
        paths.filled({paths.MEMBER_RESPONSE: tolerances.files}),
        tolerances.first_rounds,


rule sweep_dataset:
    input:
        responses=sweep.responses,
        rounds=sweep.first_rounds,
    output:
        "<results>/{kind}.nc",
    log:
        "<logs>/dataset_{kind}.log",
    wildcard_constraints:
        kind="|".join(sweep.kinds),
    conda:
        ENVIRONMENT
    resources:
        **needs.of("sweep_dataset"),
    params:
        runs=sweep.runs,
        fidelity=settings.fidelity_name,
        code=code("sweep_dataset"),
    script:
        "../scripts/sweep_dataset.py"


datasets = {kind: expand(rules.sweep_dataset.output, kind=kind)[0] for kind in sweep.kinds}


rule summary:
    input:
        **datasets,
        **({"tolerances": "<results>/tolerances.csv"} if settings.members.pairs else {}),
        campbell=rules.campbell_of_all.output[0],
    output:
        report(
            "<results>/summary.csv",
            **shown(TEXTS / "summary.rst", TOGETHER, EVERY_SCENE, figure="interactions"),
        ),
    log:
        "<logs>/summary.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("summary"),
    params:
        choice=plain(settings.interactions),
        code=code("summary"),
    script:
        "../scripts/summary.py"


rule ranking:
    input:
        **{kind: datasets[kind] for kind in sweep.kinds if kind in ("rms", "stress")},
        **({"tolerances": "<results>/tolerances.nc"} if settings.members.pairs else {}),
    output:
        report(
            "<results>/ranking.csv",
            **shown(TEXTS / "ranking.rst", TOGETHER, EVERY_SCENE, figure="ranking"),
        ),
    log:
        "<logs>/ranking.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("summary"),
    params:
        runs=sweep.runs_with("rms"),
        code=code("rank_blades"),
    script:
        "../scripts/rank_blades.py"


rule coincidences:
    input:
        campbell=rules.campbell_of_all.output[0],
    output:
        report(
            "<results>/coincidences.csv",
            **shown(TEXTS / "coincidences.rst", TOGETHER, EVERY_SCENE, figure="coincidences"),
        ),
    log:
        "<logs>/coincidences.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("summary"),
    params:
        casings=sweep.casings,
        code=code("coincidences"),
    script:
        "../scripts/coincidences.py"


rule explorer:
    input:
        **datasets,
        **({"tolerances": "<results>/tolerances.nc"} if settings.members.pairs else {}),
        campbell=rules.campbell_of_all.output[0],
        summary=rules.summary.output[0],
        ranking=rules.ranking.output[0],
    output:
        report(
            "<results>/explorer.html",
            **shown(TEXTS / "explorer.rst", TOGETHER, EVERY_SCENE, figure="explorer"),
        ),
    log:
        "<logs>/explorer.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("explorer"),
    params:
        title=f"r37 {settings.config.run.name or ''}".strip(),
        shapes=sweep.runs_with("shapes"),
        benchmark_scenes=sweep.benchmark_scenes,
        parts=parts_hash(),
        code=code("explorer"),
    script:
        "../scripts/explorer.py"
