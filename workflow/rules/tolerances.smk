# Tolerances: what is made of the members of samples, each with other values of what is never known exactly. Their models and runs
# are made by the rules of the sweep.
from r37core.tolerances import plan as tolerances_plan
from r37core.tolerances.plan import RESPONSE_OF_MEMBER, Tolerances

tolerances = settings.made(Tolerances)


use rule step as tolerances_dataset with:
    input:
        responses=paths.filled({RESPONSE_OF_MEMBER: tolerances.runs}),
        rounds=tolerances.first_rounds,
    output:
        dataset=tolerances_plan.DATASET,
    log:
        "<logs>/tolerances_dataset.log",
    params:
        **step("tolerances.steps.join"),
        members=tolerances.runs,
        numbers=tolerances.numbers,
        values=tolerances.values,
        fidelity=settings.fidelity_name,


use rule step as tolerance_table with:
    input:
        **tolerances.nominal,
        responses=paths.filled({RESPONSE_OF_MEMBER: tolerances.runs_of_sample}),
        campbells=tolerances.campbells_of_sample,
        rounds=tolerances.first_rounds,
    output:
        table=shown(tolerances_plan.TABLE, PACKAGE / "tolerances/report.rst", TOGETHER, "tolerances"),
    log:
        "<logs>/tolerance_table.log",
    params:
        **step("tolerances.steps.table"),
        members=tolerances.runs_of_sample,
        choice=plain(settings.config.interactions),
