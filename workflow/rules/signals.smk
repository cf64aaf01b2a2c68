# Time signals of chosen speeds, each a run of its own: edges of the tip, strain gauges, tip timing.
from r37core.plans.signal_plan import Signals

recorded = Signals(imported, sweep)


rule signals_of_run:
    input:
        unpack(recorded.inputs),
    output:
        paths.SIGNALS,
    log:
        "<logs>/{blade}/{scene}/signals.log",
    conda:
        ENVIRONMENT
    params:
        scene=sweep.plain_scene,
        choice=sweep.choice_of_scene,
        speeds=recorded.speeds,
        interactions=plain(settings.interactions),
        revolutions=recorded.revolutions,
        gauges=recorded.gauges,
        probes=recorded.probes,
        tip_line=recorded.tip_line,
        provenance=made.sweep,
        code=code("signals_of_run"),
    script:
        "../scripts/signals_of_run.py"


rule signals:
    input:
        recorded.files,
    output:
        paths.ALL_SIGNALS,
    log:
        "<logs>/signals.log",
    conda:
        ENVIRONMENT
    params:
        runs=recorded.runs,
        fidelity=settings.fidelity_name,
        code=code("signals"),
    script:
        "../scripts/signals.py"


rule spectrogram_figure:
    input:
        paths.SIGNALS,
    output:
        png=report(
            paths.SPECTROGRAM_FIGURE,
            **shown(TEXTS / "figure.rst", "{blade}", "{scene}", figure="spectrograms"),
        ),
        pdf=paths.as_pdf(paths.SPECTROGRAM_FIGURE),
    log:
        "<logs>/figures/spectrogram_{blade}__{scene}.log",
    conda:
        ENVIRONMENT
    params:
        caption=captioned("spectrogram"),
        code=code("spectrogram_figure"),
    script:
        "../scripts/spectrogram_figure.py"


rule orders_figure:
    input:
        paths.SIGNALS,
    output:
        png=report(
            paths.ORDERS_FIGURE,
            **shown(TEXTS / "figure.rst", "{blade}", "{scene}", figure="engine orders over time"),
        ),
        pdf=paths.as_pdf(paths.ORDERS_FIGURE),
    log:
        "<logs>/figures/orders_{blade}__{scene}.log",
    conda:
        ENVIRONMENT
    params:
        caption=captioned("orders"),
        code=code("orders_figure"),
    script:
        "../scripts/orders_figure.py"
