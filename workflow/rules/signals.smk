# Time signals of chosen speeds, each a run of its own: edges of the tip, strain gauges, tip timing.
from r37core.signals.plan import SIGNALS_OF_RUN, Signals

recorded = Signals(sweep)


use rule step as signals_of_run with:
    input:
        unpack(recorded.inputs),
    output:
        signals=SIGNALS_OF_RUN,
    log:
        "<logs>/{blade}/{scene}/signals.log",
    params:
        **step("signals.steps.record"),
        scene=simulations.plain_scene,
        choice=simulations.choice_of_scene,
        speeds=recorded.speeds,
        interactions=plain(settings.config.interactions),
        revolutions=recorded.revolutions,
        gauges=recorded.gauges,
        probes=recorded.probes,
        tip_line=recorded.tip_line,
        provenance=made.sweep,


use rule step as signals_dataset with:
    input:
        signals=paths.filled({rules.signals_of_run.output[0]: paths.run_keys(recorded.runs)}),
    output:
        dataset="<results>/signals.nc",
    log:
        "<logs>/signals.log",
    params:
        **step("signals.steps.gather"),
        runs=recorded.runs,
        fidelity=settings.fidelity_name,


use rule figure as spectrogram_figure with:
    input:
        signals=rules.signals_of_run.output[0],
    output:
        **pictures("spectrogram_{blade}__{scene}", "{blade}", "{scene}", "spectrograms"),
    log:
        "<logs>/figures/spectrogram_{blade}__{scene}.log",
    params:
        **drawing("signals.figures.draw_spectrograms", "spectrogram"),


use rule figure as contact_force_figure with:
    input:
        signals=rules.signals_of_run.output[0],
    output:
        **pictures("contact_force_{blade}__{scene}", "{blade}", "{scene}", "contact force"),
    log:
        "<logs>/figures/contact_force_{blade}__{scene}.log",
    params:
        **drawing("signals.figures.draw_contact_forces", "contact_force"),


use rule figure as orders_figure with:
    input:
        signals=rules.signals_of_run.output[0],
    output:
        **pictures("orders_{blade}__{scene}", "{blade}", "{scene}", "engine orders over time"),
    log:
        "<logs>/figures/orders_{blade}__{scene}.log",
    params:
        **drawing("signals.figures.draw_orders", "orders"),
