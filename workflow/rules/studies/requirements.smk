# Requirements in operation: further runs, and the verdict on each blade and scene.
from r37studies.requirements.plan import ALL_LOOKS, LOOKS, VERDICT, Judged

judged = Judged(sweep)
stages |= {"looks": judged.looks()}


use rule step as looks with:
    input:
        unpack(sweep.run_inputs),
        unpack(judged.coarser_model),
        response=paths.RESPONSE,
    output:
        looks=LOOKS,
    log:
        "<logs>/{blade}/{scene}/looks.log",
    params:
        **stage("r37studies.requirements.steps.look"),


use rule step as verdict with:
    input:
        **{kind: datasets[kind] for kind in sweep.kinds if kind in ("rms", "stress", "fatigue", "wear")},
        **members,
        **more_motions,
        **run_up_dataset,
        **offered("measured", sweep),
        campbell=rules.campbell_of_all.output[0],
        volumes=judged.volumes,
        looks=paths.filled({LOOKS: paths.run_keys(judged.looked)}),
    output:
        verdict=shown(VERDICT, SOURCE / "r37studies/requirements/report.rst", TOGETHER, "verdict"),
        runs=ALL_LOOKS,
    log:
        "<logs>/verdict.log",
    params:
        **step("r37studies.requirements.steps.judge"),
        pairs=sweep.runs_with("rms"),
        looked=judged.looked,
        known=[judged.known_of(*pair) for pair in sweep.runs_with("rms")],
        requirements=judged.requirements,
        operating=operating,
        densities=judged.densities,
