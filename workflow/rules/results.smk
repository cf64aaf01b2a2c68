# The datasets over all blades and scenes, and the list of interactions.


use rule step as configuration with:
    output:
        configuration=shown(
            "<results>/configuration.json", TEXTS / "configuration.rst", "Configuration", "configuration"
        ),
    log:
        "<logs>/configuration.log",
    priority: 20
    params:
        **step("r37core.results.steps.configuration"),
        merged=merged_settings(settings),


# all that lies in the folders of the blades, which jobs of a cluster make (docs/cluster.md)
rule responses:
    input:
        expand(paths.CAMPBELL, blade=settings.blades),
        paths.filled({paths.RESPONSE: paths.run_keys(sweep.runs_with("rms"))}),
        sweep.first_rounds,
        simulated(sweep),


use rule step as sweep_dataset with:
    input:
        responses=lambda wildcards: paths.filled({paths.RESPONSE: paths.run_keys(sweep.runs_with(wildcards.kind))}),
        rounds=sweep.first_rounds,
    output:
        dataset="<results>/{kind}.nc",
    log:
        "<logs>/dataset_{kind}.log",
    wildcard_constraints:
        kind="|".join(sweep.kinds),
    params:
        **step("r37core.results.steps.sweep_dataset"),
        kind="{kind}",
        runs=lambda wildcards: sweep.runs_with(wildcards.kind),
        fidelity=settings.fidelity_name,


datasets = {kind: expand(rules.sweep_dataset.output, kind=kind)[0] for kind in sweep.kinds}


use rule step as summary with:
    input:
        **datasets,
        **{name: each.file for name, each in more_columns["summary"].items()},
        **further_runs,
        campbell=rules.campbell_of_all.output[0],
    output:
        table=shown("<results>/summary.csv", TEXTS / "summary.rst", TOGETHER, "interactions"),
    log:
        "<logs>/summary.log",
    params:
        **adding("r37core.results.steps.summary", "summary"),
        choice=plain(settings.config.interactions),


use rule step as ranking with:
    input:
        **{kind: datasets[kind] for kind in sweep.kinds if kind in ("rms", "stress", "fatigue")},
        **members,
        **{name: each.file for name, each in more_columns["ranking"].items()},
        **further_runs,
    output:
        table=shown("<results>/ranking.csv", TEXTS / "ranking.rst", TOGETHER, "ranking"),
    log:
        "<logs>/ranking.log",
    params:
        **adding("r37core.results.steps.ranking", "ranking"),
        runs=sweep.runs_with("rms"),
        errors=level_errors(settings, sweep.runs_with("rms")),
        operating=operating,
        contacts=contact_of_blades(settings),


use rule step as coincidences with:
    input:
        campbell=rules.campbell_of_all.output[0],
    output:
        table=shown("<results>/coincidences.csv", TEXTS / "coincidences.rst", TOGETHER, "coincidences"),
    log:
        "<logs>/coincidences.log",
    params:
        **step("r37core.results.steps.coincidences"),
        casings=to_plain(elastic_casings(settings)),


shown_panels = panels(sweep)
programs = [str(SOURCE / panel.program) for panel in shown_panels.values()]


use rule step as explorer with:
    input:
        **datasets,
        **{name: panel.table for name, panel in shown_panels.items()},
        **further_runs,
        campbell=rules.campbell_of_all.output[0],
    output:
        page=shown("<results>/explorer.html", TEXTS / "explorer.rst", TOGETHER, "explorer"),
    log:
        "<logs>/explorer.log",
    params:
        **step(
            "r37core.explorer.steps.explorer", *(panel.contents.rpartition(".")[0] for panel in shown_panels.values())
        ),
        panels={name: panel.contents for name, panel in shown_panels.items()},
        programs=programs,
        title=f"r37 {settings.config.run.name or ''}".strip(),
        operating=operating,
        links=links(sweep),
        parts=parts_hash(page_parts(programs)),
