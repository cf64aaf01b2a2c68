# The study `stability`: what happens at extremes.
from r37core.studies.stability_plan import Stability

stability = Stability(settings)


rule stability_case:
    input:
        contact=stability.model,
    output:
        paths.STABILITY_CASE,
    log:
        "<logs>/studies/stability/{extreme}.log",
    wildcard_constraints:
        extreme=r"[\w.+-]+",
    conda:
        ENVIRONMENT
    params:
        extreme=stability.extreme,
        scene=stability.scene,
        described=stability.described,
        choice=stability.choice,
        code=code("stability_case"),
    script:
        "../../scripts/stability_case.py"


rule stability:
    input:
        stability.cases,
    output:
        "<results>/studies/stability.md",
    log:
        "<logs>/studies/stability.log",
    conda:
        ENVIRONMENT
    params:
        code=code("stability"),
    script:
        "../../scripts/stability.py"
