# Tolerances: members of each blade and scene, with other values of what is never known exactly, and what is made of them.
from r37studies.tolerances import plan as tolerances_plan
from r37core.sweep.recipe import structure_attributes
from r37studies.tolerances.members import Tolerances

tolerances = settings.made(Tolerances)


# on the cores that are free, for its members and their speeds; what it had done is there when it is started again
use rule step as tolerance_members with:
    input:
        prepared=paths.INTEGRATION_STAMP,
        models=sweep.models,
        campbell=paths.CAMPBELL,
    output:
        members=tolerances_plan.MEMBERS,
    log:
        "<logs>/tolerances/{blade}/{scene}/members.log",
    priority: 3
    threads: lambda wildcards: int(tolerances.runs[wildcards.blade, wildcards.scene].number)
    resources:
        mem_mb=lambda wildcards, threads: 500 * threads,
    params:
        **step("r37studies.tolerances.steps.run"),
        sweeps=tolerances.sweeps,
        speeds=tolerances.speeds,
        structure=lambda wildcards: structure_attributes(settings, wildcards.blade),
        about=tolerances.about,
        provenance=sweep.provenance,


use rule step as tolerances_dataset with:
    input:
        members=paths.filled({tolerances_plan.MEMBERS: paths.run_keys(tolerances.pairs)}),
    output:
        dataset=tolerances_plan.DATASET,
    log:
        "<logs>/tolerances_dataset.log",
    params:
        **step("r37studies.tolerances.steps.join"),
        samples=tolerances.samples,
        numbers=[number.key for number in tolerances.numbers],
        fidelity=settings.fidelity_name,


use rule step as tolerance_table with:
    input:
        **tolerances.nominal,
        members=paths.filled({tolerances_plan.MEMBERS: paths.run_keys(tolerances.pairs)}),
        rounds=tolerances.first_rounds,
    output:
        table=shown(tolerances_plan.TABLE, SOURCE / "r37studies/tolerances/report.rst", TOGETHER, "tolerances"),
    log:
        "<logs>/tolerance_table.log",
    params:
        **step("r37studies.tolerances.steps.table"),
        samples=tolerances.samples,
        choice=plain(settings.config.interactions),
