# Requirements in operation: what lies in the operating range, and the verdict on each blade and scene.
from r37core.requirements.plan import VERDICT, Judged

judged = Judged(sweep)


use rule step as verdict with:
    input:
        **{kind: datasets[kind] for kind in sweep.kinds if kind in ("rms", "stress", "fatigue", "wear")},
        **({"members": sampling.dataset} if sampling else {}),
        **more_motions,
        campbell=rules.campbell_of_all.output[0],
        volumes=judged.volumes,
    output:
        verdict=shown(VERDICT, PACKAGE / "requirements/report.rst", TOGETHER, "verdict"),
    log:
        "<logs>/verdict.log",
    params:
        **step("requirements.steps.judge"),
        pairs=sweep.runs_with("rms"),
        requirements=judged.requirements,
        operating=operating,
        densities=judged.densities,
        clearance=judged.clearance,
        thickness=judged.thickness,


use rule step as operating with:
    input:
        **{kind: datasets[kind] for kind in sweep.kinds if kind in ("rms", "stress")},
        campbell=rules.campbell_of_all.output[0],
        summary=rules.summary.output[0],
    output:
        table="<results>/operating.csv",
    log:
        "<logs>/operating.log",
    params:
        **step("requirements.steps.list_operating"),
        pairs=sweep.runs_with("rms"),
        operating=operating,
