# The study `refinement`: what speeds that refine themselves find, of how many runs, against every speed of their grid.
from r37core.studies.refinement_plan import Refinement

refinement = Refinement(settings)


rule campaign:
    input:
        unpack(sweep.recovery),
        model=sweep.contact_model,
        prepared=paths.INTEGRATION_STAMP,
    output:
        paths.CAMPAIGN,
    log:
        "<logs>/studies/refinement/{blade}__{scene}.log",
    priority: sweep.priority
    conda:
        ENVIRONMENT
    params:
        speeds=refinement.every_speed,
        scene=sweep.scene,
        described=sweep.described,
        choice=sweep.choice_of_scene,
        results=refinement.results,
        kept=sweep.kept,
        stress_instants=settings.fidelity.time_integration.stress_instants,
        material=structure.material,
        provenance=made.sweep,
        code=code("campaign"),
    script:
        "../../scripts/campaign.py"


rule refinement:
    input:
        campbell="<results>/campbell.nc",
        campaigns=refinement.campaigns,
    output:
        "<results>/studies/refinement.md",
    log:
        "<logs>/studies/refinement.log",
    conda:
        ENVIRONMENT
    params:
        runs=refinement.runs,
        plans=refinement.plans,
        steps=refinement.steps,
        choice=sweep.refinement_choice,
        interactions=plain(settings.interactions),
        code=code("refinement"),
    script:
        "../../scripts/refinement.py"
