# Time signals of chosen speeds, each a run of its own: edges of the tip, strain gauges, tip timing.
from r37studies.signals import plan as signals_plan

recorded = signals_plan.Signals(sweep)


use rule step as signals_of_run with:
    input:
        unpack(recorded.inputs),
    output:
        signals=signals_plan.SIGNALS_OF_RUN,
    log:
        "<logs>/{blade}/{scene}/signals.log",
    params:
        **step("r37studies.signals.steps.record"),
        scene=sweep.plain_scene,
        choice=sweep.choice_of_scene,
        speeds=recorded.speeds,
        interactions=plain(settings.config.interactions),
        revolutions=recorded.revolutions,
        gauges=recorded.gauges,
        probes=recorded.probes,
        tip_line=lambda wildcards: settings.scenes[wildcards.scene].tip_line,
        provenance=sweep.provenance,
