# Tolerances: what is made of the members of samples, each with other values of what is never known exactly. Their models and runs
# are made by the rules of the sweep.


rule tolerances_dataset:
    input:
        responses=tolerances.responses,
        rounds=tolerances.first_rounds,
    output:
        "<results>/tolerances.nc",
    log:
        "<logs>/tolerances_dataset.log",
    conda:
        ENVIRONMENT
    resources:
        **needs.of("tolerances_dataset"),
    params:
        members=tolerances.runs,
        numbers=tolerances.numbers,
        values=tolerances.values,
        fidelity=settings.fidelity_name,
        code=code("tolerances_dataset"),
    script:
        "../scripts/tolerances_dataset.py"


rule tolerance_table:
    input:
        **tolerances.nominal,
        responses=tolerances.responses_of_sample,
        campbells=tolerances.campbells_of_sample,
        rounds=tolerances.first_rounds,
    output:
        report(
            "<results>/tolerances.csv",
            **shown(TEXTS / "tolerances.rst", TOGETHER, EVERY_SCENE, figure="tolerances"),
        ),
    log:
        "<logs>/tolerance_table.log",
    conda:
        ENVIRONMENT
    params:
        members=tolerances.runs_of_sample,
        choice=plain(settings.interactions),
        code=code("tolerance_table"),
    script:
        "../scripts/tolerance_table.py"


use rule figure as tolerance_figure with:
    input:
        tolerances=rules.tolerances_dataset.output[0],
        nominal=paths.nominal(paths.RESPONSE),
    output:
        **pictures("tolerances_{blade}__{scene}", "{blade}", "{scene}", "tolerances"),
    log:
        "<logs>/figures/tolerances_{blade}__{scene}.log",
    params:
        **drawing(code, "figures.tolerance_curves.draw_tolerances", "tolerances"),


# the members alone, with the nominal runs beside them
rule tolerances:
    input:
        paths.filled({name: wildcards for name, wildcards in targets(sweep).items() if "tolerances" in name}),
