# Studies of the model itself; none is part of all_blades. A study is a folder of r37core.studies: what runs, and what is said.
from r37core.studies.case import MODEL_NAME
from r37core.studies.plan import STUDIES, Studies

studies = Studies(settings)


use rule step as study_model with:
    input:
        geometry=paths.nominal(paths.GEOMETRY),
    output:
        rom=paths.STUDY_MODEL.replace("{file}", "rom.nc"),
        contact=paths.STUDY_MODEL.replace("{file}", "contact.npz"),
        cost=paths.STUDY_MODEL.replace("{file}", "cost.json"),
    log:
        paths.STUDY_MODEL.replace("{file}", "model.log").replace("<results>", "<logs>"),
    wildcard_constraints:
        model=MODEL_NAME,
    priority: 2
    params:
        **step("studies.steps.model"),
        choice=studies.model,
        reduction=structure.base_reduction,
        material=studies.material,
        provenance=made.structure,


use rule campbell_of_blade as study_campbell with:
    input:
        rom=paths.STUDY_MODEL.replace("{file}", "rom.nc"),
    output:
        campbell=paths.STUDY_MODEL.replace("{file}", "campbell.nc"),
    log:
        paths.STUDY_MODEL.replace("{file}", "campbell.log").replace("<results>", "<logs>"),
    wildcard_constraints:
        model=MODEL_NAME,


use rule step as study_case with:
    input:
        unpack(studies.case_inputs),
    output:
        response=paths.STUDY_CASE,
    log:
        paths.STUDY_CASE.replace("<results>", "<logs>").replace(".nc", ".log"),
    wildcard_constraints:
        study="|".join(STUDIES),
        case=r"[\w.+/-]+",
    params:
        **step("studies.steps.case"),
        case=studies.case,


for study in STUDIES:

    rule:
        name:
            study
        input:
            unpack(studies.inputs(study)),
        output:
            **studies.outputs(study),
        log:
            f"<logs>/studies/{study}.log",
        conda:
            ENVIRONMENT
        params:
            **step("studies.steps.report", f"studies.{study}.report"),
            study=study,
            cases=studies.names(study),
            values=studies.values(study),
        script:
            "../scripts/step.py"
