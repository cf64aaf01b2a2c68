# Measurements beside the simulation, and numbers fitted to them.
from r37studies.measured import plan as measured_plan
from r37studies.measured.calibration_plan import Calibrated
from r37studies.measured.measurement_plan import Measured
from r37studies.carried import Carried

measured = settings.made(Measured)
calibrated = settings.made(Calibrated)


use rule step as observed with:
    input:
        unpack(measured.inputs),
    output:
        observed=measured_plan.OBSERVED,
    log:
        "<logs>/{blade}/{scene}/observed.log",
    params:
        **step("r37studies.measured.steps.observe"),
        scene=sweep.plain_scene,
        choice=lambda wildcards: to_plain(settings.integration_choice(wildcards.blade, wildcards.scene)),
        measurements=lambda wildcards: to_plain(measured.pair_measurements((wildcards.blade, wildcards.scene))),
        tip_line=lambda wildcards: settings.scenes[wildcards.scene].tip_line,


use rule step as measured_table with:
    input:
        observed=paths.filled({measured_plan.OBSERVED: paths.run_keys(measured.pairs)}),
    output:
        table=shown(measured_plan.TABLE, SOURCE / "r37studies/measured/report.rst", TOGETHER, "measurements"),
    log:
        "<logs>/measured.log",
    params:
        **step("r37studies.measured.steps.compare"),
        measurements=to_plain(measured.all),
        pairs=measured.pairs,
        errors=level_errors(settings, measured.pairs),


# on the cores that are free; designs that are done are there when it is started again
use rule step as calibration with:
    input:
        **(calibrated.inputs() if settings.section(measured_plan.CALIBRATE) else {}),
    output:
        dataset=measured_plan.DATASET,
        table=measured_plan.NUMBERS,
        folder=directory(measured_plan.FOLDER),
    log:
        "<logs>/calibration.log",
    priority: 3
    threads: lambda wildcards: sum(int(runs.number) for runs in measured_plan.simulations(settings).values())
    resources:
        mem_mb=lambda wildcards, threads: (memory_of_model + 300) * threads,
    params:
        **step("r37studies.measured.steps.calibrate"),
        carried=lambda wildcards: Carried(settings),
        made_of=calibrated.made_of,
