# Studies of the model itself; none is part of all_blades. The models of blades that they need beside those of the sweep.
from r37core.studies.study_models import PARTS, StudyModels

study_models = StudyModels(settings)


rule study_model:
    input:
        paths.GEOMETRY,
    output:
        rom=paths.STUDY_MODEL.replace("{file}", "rom.nc"),
        contact=paths.STUDY_MODEL.replace("{file}", "contact.npz"),
        cost=paths.STUDY_MODEL.replace("{file}", "cost.json"),
    log:
        paths.STUDY_MODEL.replace("{file}", "model.log").replace("<results>", "<logs>"),
    wildcard_constraints:
        **PARTS,
    priority: 2
    conda:
        ENVIRONMENT
    params:
        choice=study_models.choice,
        reduction=structure.base_reduction,
        material=study_models.material,
        provenance=made.structure,
        code=code("study_model"),
    script:
        "../../scripts/study_model.py"
