# The study `refinement`: what speeds that refine themselves find, of how many runs, against every speed of their grid.
from r37core.workflow.refinement import Refinement

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
