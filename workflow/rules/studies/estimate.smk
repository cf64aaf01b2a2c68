# The study `estimate`: what a sweep will cost.
from r37core.studies.estimate_plan import Estimate

estimate = Estimate(settings)


rule estimate_sample:
    input:
        unpack(sweep.recovery),
        model=sweep.contact_model,
        prepared=paths.INTEGRATION_STAMP,
    output:
        paths.ESTIMATE_SAMPLE,
    log:
        "<logs>/studies/estimate/{blade}__{scene}.log",
    conda:
        ENVIRONMENT
    params:
        scene=sweep.scene,
        described=sweep.described,
        choices=estimate.choices,
        number=estimate.number,
        results=sweep.results,
        kept=sweep.kept,
        stress_instants=settings.fidelity.time_integration.stress_instants,
        material=structure.material,
        code=code("estimate_sample"),
    script:
        "../../scripts/estimate_sample.py"


rule estimate:
    input:
        estimate.samples,
    output:
        json="<results>/studies/estimate.json",
        table="<results>/studies/estimate.md",
    log:
        "<logs>/studies/estimate.log",
    conda:
        ENVIRONMENT
    params:
        workflow_s_per_job=settings.studies.estimate.workflow_s_per_job,
        cores=settings.studies.estimate.cores,
        fidelity=settings.fidelity_name,
        code=code("estimate"),
    script:
        "../../scripts/estimate.py"
